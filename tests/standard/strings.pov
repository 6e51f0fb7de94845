// Numbers, vectors and colours as text.
#version 3.7; global_settings { assumed_gamma 1 }
#include "strings.inc"
#debug concat("|",CRGBStr(rgb<1,.5,.25>,0,3),"|\n")
#debug concat("|",CRGBStr(rgb<1,.5,.25>,0,-1),"|\n")
#debug concat("|",CRGBFTStr(rgbft<1,.5,.25,.1,.2>,6,2),"|\n")
#debug concat("|",Str(1/3),"|",VStr2D(<1,2>),"|",VStr(<1,2,3>),"|\n")
#debug concat("|",Vstr2D(<1,2>,5,1),"|",Vstr(<1,2,3>,-6,2),"|\n")
#debug concat(Triangle_Str(x,y,z),"|\n")
#debug concat(Smooth_Triangle_Str(x,y,y,z,z,x),"|\n")
