// Arrays reversed, sorted, resized, chosen from.
#version 3.7; global_settings { assumed_gamma 1 }
#include "arrays.inc"
#macro P(A) #local I=0; #while(I<dimension_size(A,1)) #ifdef(A[I]) #debug concat(str(A[I],0,1)," ") #else #debug "- " #end #local I=I+1; #end #debug " " #end
#declare A=array[7]{5,3,8,1,9,2,7}
P(A) Reverse_Array(A) P(A) Sort_Array(A) P(A) #declare A=array[7]{5,3,8,1,9,2,7} Sort_Partial_Array(A,2,5) P(A) Resize_Array(A,4) P(A) Resize_Array(A,6) P(A)
#declare B=array[8]{5,3,8,1,9,2,7,6} Reverse_Array(B) P(B) Sort_Array(B) P(B)
#declare C=array[1]{5} Sort_Array(C) P(C) Reverse_Array(C) P(C)
#local R=seed(7); #local I=0; #while (I<12) #debug str(Rand_Array_Item(B,R),0,0) #local I=I+1; #end #debug "\n"
