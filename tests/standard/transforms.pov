// Where transforms take points.
#version 3.7; global_settings { assumed_gamma 1 }
#include "transforms.inc"
#macro ZV(ZN,ZA) #debug concat(ZN," ",vstr(3,ZA+1e-9,",",0,5),"\n") #end
#macro W(ZN,Tr,PP) #local OO=sphere{PP,1e-3 transform {Tr}} ZV(ZN,(min_extent(OO)+max_extent(OO))/2) #end #macro T(ZN,Tr) W(ZN,Tr,<1,2,3>) W(ZN,Tr,<1,0,0>) W(ZN,Tr,<0,1,0>) W(ZN,Tr,<0,0,1>) #end
#declare S=sphere{<1,2,3>,2}
#declare T1=Shear_Trans(<1,2,3>,<0,1,1>,<2,0,1>) T("shear",T1)
#declare T1=Matrix_Trans(<1,2,3>,<0,1,1>,<2,0,1>,<5,6,7>) T("matrix",T1)
#declare T1=Axial_Scale_Trans(<1,2,3>,2.5) T("ax",T1)
#declare T1=Axis_Rotate_Trans(<1,2,3>,50) T("axrot",T1)
#declare T1=Rotate_Around_Trans(<10,20,30>,<3,2,1>) T("around",T1)
#declare T1=Reorient_Trans(<1,2,3>,<3,-1,1>) T("reo",T1)
#declare T1=Reorient_Trans(x,y) T("reo",T1)
#declare T1=Reorient_Trans(x,x) T("reo",T1)
#declare T1=Reorient_Trans(x,-x) T("reo-",T1)
#declare T1=Reorient_Trans(y,-y) T("reo-",T1)
#declare T1=Reorient_Trans(<1,2,3>,-<1,2,3>) T("reo-",T1)
#declare T1=Point_At_Trans(<1,2,3>) T("pa",T1)
#declare T1=Point_At_Trans(y) T("pa",T1)
#declare T1=Point_At_Trans(-y) T("pa",T1)
#declare T1=Point_At_Trans(x) T("pa",T1)
#declare T1=Point_At_Trans(z) T("pa",T1)
#declare T1=Point_At_Trans(-z) T("pa",T1)
#declare T1=Center_Trans(S,x+z) T("ce",T1)
#declare T1=Align_Trans(S,<1,-1,0>,<5,6,7>) T("al",T1)
#declare SP=spline{natural_spline 0,<0,0,0> 1,<1,2,0> 2,<3,1,2> 3,<4,4,4>}
#declare T1=Spline_Trans(SP,.5,y,.1,.5) T("sp",T1)
#declare T1=Spline_Trans(SP,1.5,y,.2,1) T("sp",T1)
#declare T1=transform { rotate <10,20,30> scale <1,2,3> translate <3,2,1> }
ZV("to",vtransform(<1,2,3>,T1)) ZV("from",vinv_transform(<1,2,3>,T1))
ZV("to",vtransform(<1,2,3>,transform { rotate 90*y }))
