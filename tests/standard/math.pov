// Functions of numbers and vectors.
#version 3.7; global_settings { assumed_gamma 1 }
#include "consts.inc"
#include "math.inc"
#declare D = array[9] {-3,-2.5,-1,-0.3,0,0.5,1,2,7.25}
#local I=0; #while (I<9) #local N=D[I];
#debug concat(str(N,0,2)," even ",str(even(N),0,3)," odd ",str(odd(N),0,3)," sgn ",str(sgn(N),0,3),"\n")
#debug concat(" sqr ",str(f_sqr(N),0,3)," clip ",str(clip(N,-1,2),0,3)," clamp ",str(clamp(N,-1,2),0,3),"\n")
#debug concat(" adj ",str(adj_range(N,2,5),0,3)," adj2 ",str(adj_range2(N,-1,2,4,10),0,3),"\n")
#debug concat(" ",str(sind(N*30),0,4)," ",str(cosd(N*30)+1e-9,0,4)," ",str(tand(N*20),0,4)," ",str(atand(N),0,4),"\n")
#debug concat(" ",str(atan2d(N,2),0,4)," ",str(asind(max(-1,min(1,N))),0,4)," ",str(acosd(max(-1,min(1,N))),0,4),"\n")
#local I=I+1; #end
#debug concat("e ",str(e,0,9)," o ",vstr(3,o,",",0,1)," ",str(FoV_15,0,9)," ",str(FoV_90,0,9)," ",str(FoV_120,0,9),"\n")
#local I=2; #while (I<=10) #debug concat("interp ",str(Interpolate(I,0,10,2,5,0),0,4)," ",str(Interpolate(I,0,10,2,5,1),0,4)," ",str(Interpolate(I,0,10,2,5,2),0,4)," ",str(Interpolate(I,0,10,2,5,-2),0,4)," ",str(Interpolate(I,0,10,2,5,.5),0,4)," ",str(Interpolate(I,0,10,2,5,-.5),0,4),"\n") #local I=I+2; #end
#declare A=array[4]{1,5,2,8}
#debug concat("mean ",str(Mean(A),0,4)," sd ",str(Std_Dev(A,Mean(A)),0,6),"\n")
#macro ZV(ZN,ZA) #debug concat(ZN," ",vstr(5,ZA,",",0,6),"\n") #end
#macro ZS(ZN,ZA) #debug concat(ZN," ",str(ZA,0,6),"\n") #end
#declare P=<1,2,-3>; #declare Q=<0.5,-1,4>;
ZV("sqr",VSqr(P)) ZV("pow",VPow(<1,2,3>,1.5)) ZV("pow5",VPow5D(<1,2,3,4,5>,1.5)) ZS("eq",VEq(P,P)) ZS("eq",VEq(P,Q)) ZS("eq",VEq(P,P+1e-11)) ZS("eq",VEq(P,P+1e-7)) ZS("eq5",VEq5D(<1,2,3,4,5>,<1,2,3,4,5>)) ZS("eq5",VEq5D(<1,2,3,4,5>,<1,2,3,4,6>)) ZS("z",VZero(0*x)) ZS("z",VZero(x)) ZS("z",VZero(x*1e-7)) ZS("z5",VZero5D(<0,0,0,0,0>)) ZS("z5",VZero5D(<0,0,0,0,1>))
ZS("l5",VLength5D(<1,2,3,4,5>)) ZV("n5",VNormalize5D(<1,2,3,4,5>)) ZS("d5",VDot5D(<1,2,3,4,5>,<2,3,4,5,6>)) ZS("ca",VCos_Angle(P,Q)) ZS("a",VAngle(P,Q)) ZS("ad",VAngleD(P,Q)) ZS("a",VAngle(P,P)) ZS("rot",VRotation(x,y,z)) ZS("rot",VRotation(x,y,-z)) ZS("rot",VRotation(x,-y,z)) ZS("rot",VRotation(x,-x,z)) ZS("rot",VRotation(x,y,0*x)) ZS("rot",VRotationD(x+y,y,z)) ZS("rotD",VRotationD(P,Q,vcross(P,Q))) ZS("rotD",VRotationD(P,Q,-vcross(P,Q)))
ZS("dist",VDist(P,Q)) ZV("pv",VPerp_To_Vector(P)+1e-9) ZV("pv",VPerp_To_Vector(x)+1e-9) ZV("pv",VPerp_To_Vector(y)+1e-9) ZV("pv",VPerp_To_Vector(z)+1e-9) ZV("pv",VPerp_To_Vector(<0,-2,1>)+1e-9) ZV("pv",VPerp_To_Vector(<3,.1,1>)+1e-9) ZV("pv",VPerp_To_Vector(<.3,.1,1>)+1e-9) ZV("pv",VPerp_To_Vector(<.3,.3,.3>)+1e-9) ZV("pv",VPerp_To_Vector(-z)+1e-9) ZV("pp",VPerp_To_Plane(P,Q)) ZV("pa",VPerp_Adjust(P,Q)) ZV("pj",VProject_Plane(P,Q)) ZV("pj",VProject_Plane(P,2*y)) ZV("px",VProject_Axis(P,Q)) ZV("px",VProject_Axis(P,2*y)) ZS("min",VMin(P)) ZS("max",VMax(P)) ZV("len",VWith_Len(P,5)) ZV("len",VWith_Len(P,-5))
ZS("max3",max3(1,5,2)) ZS("min3",min3(1,5,2))
SetGradientAccuracy(0.1)
#declare F=function(x,y,z){x*x*x+2*y*z}
#declare G=function(x,y,z){y*y*y+x*z}
#declare H=function(x,y,z){z*z*z+2*y*x}
#declare P=<1,2,3>;
ZV("g",vGradient(F,P)) ZS("gl",Gradient_Length(F,P)) ZS("gd",Gradient_Directional(F,P,<1,2,2>)) ZS("div",Divergence(F,G,H,P)) ZV("curl",vCurl(F,G,H,P))
#declare K1=fn_Gradient(F) ZS("fg",K1(1,2,3))
#declare K2=fn_Gradient_Directional(F,<1,2,2>) ZS("fgd",K2(1,2,3))
#declare K3=fn_Divergence(F,G,H) ZS("fdiv",K3(1,2,3))
#declare A=array[5]{<1,2,3>,<2,3,4>,<0,0,0>,<4,5,6>,<1,1,1>} ZV("mean",Mean(A))
