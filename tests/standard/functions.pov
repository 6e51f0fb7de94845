// Waves.
#version 3.7; global_settings { assumed_gamma 1 }
#include "functions.inc"
#macro ZS(ZN,ZA) #debug concat(ZN," ",str(ZA,0,6),"\n") #end
ZS("sine",f_sine_wave(.1,2,3)) ZS("sine",f_sine_wave(.3,1,1)) ZS("sine",f_sine_wave(-.3,1,1)) ZS("sc",f_scallop_wave(.1,2,3)) ZS("sc",f_scallop_wave(.3,1,1)) ZS("sc",f_scallop_wave(-.3,1,1))
