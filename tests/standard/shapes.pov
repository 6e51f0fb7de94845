// Where rays meet, boxes lie and objects go.
#version 3.7; global_settings { assumed_gamma 1 }
#include "shapes.inc"
#macro E(N,O) #local A=min_extent(O)+1e-9; #local B=max_extent(O)+1e-9; #debug concat(N," ",vstr(3,A,",",0,4)," ",vstr(3,B,",",0,4),"\n") #end
#declare S=sphere{<1,2,3>,2}
#declare B1=object{Spheroid(<1,2,3>,<1,2,3>)} E("spheroid",B1)
#declare P=<0,0,0>; #declare N=<0,0,0>;
#debug concat(str(Isect(<1,2,-9>,z,S,P),0,0)," ",vstr(3,P+1e-9,",",0,3),"\n")
#debug concat(str(IsectN(<1,2,-9>,z,S,P,N),0,0)," ",vstr(3,P+1e-9,",",0,3)," ",vstr(3,N+1e-9,",",0,3),"\n")
#debug concat(str(Isect(<1,2,-9>,-z,S,P),0,0)," ",vstr(3,P+1e-9,",",0,3),"\n")
Extents(S,P,N) #debug concat(vstr(3,P+1e-9,",",0,3)," ",vstr(3,N+1e-9,",",0,3),"\n")
#declare O=object{Center_Object(S,x+y)} E("centred",O)
#declare O=object{Center_Object(S,z)} E("centred",O)
#declare O=object{Align_Object(S,<1,-1,0>,<5,6,7>)} E("aligned",O)
#declare O=object{Align_Object(S,<-1,0,1>,<5,6,7>)} E("aligned",O)
#declare W=object{Wedge(200)}
#debug concat(str(inside(W,<0.1,0,1>),0,0),str(inside(W,<-.6,0,-1>),0,0),str(inside(W,<-.1,0,1>),0,0),str(inside(W,<.1,0,-1>),0,0),str(inside(W,<-.3,0,-1>),0,0),"\n")
#debug concat(str(Align_Left,0,0),str(Align_Right,0,0),str(Align_Center,0,0),"\n")
