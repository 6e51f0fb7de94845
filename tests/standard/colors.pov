// Colours to hue, saturation, lightness and value, and back.
#version 3.7; global_settings { assumed_gamma 1 }
#include "colors.inc"
#macro P(N,C) #local Q=rgbft 0+C; #debug concat(N," ",str(Q.red,0,5)," ",str(Q.green,0,5)," ",str(Q.blue,0,5)," ",str(Q.filter,0,5)," ",str(Q.transmit,0,5),"\n") #end
#declare L = array[10] {rgb<1,0,0>, rgb<.2,.4,.6>, rgb <.6,.4,.2>, rgb <.1,.9,.3>, rgb 0, rgb 1, rgb .5, rgbft<.3,.2,.9,.4,.5>, rgb <1.5,-.2,.3>, rgb<.9,.2,.5>}
#local I=0;
#while (I<10)
P("hsl",CRGB2HSL(L[I])) P("hsv",CRGB2HSV(L[I]))
#local I=I+1; #end
#local I=0; #while (I<=720) #local J=0; #while (J<=3)
P("h",CH2RGB(I)) P("l",CHSL2RGB(<I,.25*J,.3+J/5>))  P("v",CHSV2RGB(<I,.25*J,.3+J/5,.1,.2>))
#local J=J+1; #end
#local I=I+35; #end
P("h",CH2RGB(-30)) P("h",CH2RGB(-400)) P("h",CH2RGB(1000))
P("a",CRGB2HSL(<.9,.2,.5,.1,.2>))
P("l",CHSL2RGB(<20,.5,1.2>)) P("v",CHSV2RGB(<20,1.5,1.2>)) P("l",CHSL2RGB(<20,2,.6>))
P("l",CHSL2RGB(rgb<20,.5,.2>)) P("l",CHSL2RGB(rgbft<20,.5,.2,.3,.4>))
