// Random numbers: the same as POV-Ray draws.
#version 3.7; global_settings { assumed_gamma 1 }
#include "rand.inc"
#macro ZV(ZN,ZA) #debug concat(ZN," ",vstr(3,ZA,",",0,9),"\n") #end
#macro ZS(ZN,ZA) #debug concat(ZN," ",str(ZA,0,9),"\n") #end
#local Q=seed(7); ZS("r",rand(Q))ZS("r",rand(Q))ZS("r",rand(Q))ZS("r",rand(Q))ZS("r",rand(Q))ZS("r",rand(Q))ZS("r",rand(Q))ZS("r",rand(Q))

#local R=seed(7); ZS("srand",SRand(R)) ZS("srand",SRand(R))
#local R=seed(7); ZS("rrand",RRand(2,5,R)) ZS("next",rand(R))
#local R=seed(7); ZV("vrand",VRand(R)) ZS("next",rand(R))
#local R=seed(7); ZV("vbox",VRand_In_Box(<1,2,3>,<2,4,6>,R)) ZS("next",rand(R))
#local R=seed(7); ZV("vins",VRand_In_Sphere(R)) ZS("next",rand(R)) ZV("vins",VRand_In_Sphere(R)) ZS("next",rand(R))
#local R=seed(7); ZV("vons",VRand_On_Sphere(R)) ZS("next",rand(R)) ZV("vons",VRand_On_Sphere(R)) ZS("next",rand(R))
#local R=seed(7); ZV("vobj",VRand_In_Obj(sphere{<1,2,3>,1},R)) ZS("next",rand(R))
#local R=seed(7); ZS("cauchy",Rand_Cauchy(1,2,R)) ZS("next",rand(R))
#local R=seed(7); ZS("student",Rand_Student(5,R)) ZS("next",rand(R))
#local R=seed(7); ZS("normal",Rand_Normal(1,2,R)) ZS("next",rand(R)) ZS("normal",Rand_Normal(1,2,R)) ZS("next",rand(R))
#local R=seed(7); ZS("gauss",Rand_Gauss(1,2,R)) ZS("next",rand(R)) ZS("gauss",Rand_Gauss(1,2,R)) ZS("next",rand(R)) ZS("gauss",Rand_Gauss(1,2,R)) ZS("next",rand(R))
#local R=seed(7); ZS("gamma",Rand_Gamma(2,3,R)) ZS("next",rand(R)) ZS("gamma",Rand_Gamma(.5,3,R)) ZS("next",rand(R))
#local R=seed(7); ZS("gamma1",Rand_Gamma(1,3,R)) ZS("next",rand(R)) 
#local R=seed(7); ZS("beta",Rand_Beta(2,3,R)) ZS("next",rand(R))
#local R=seed(7); ZS("chi",Rand_Chi_Square(3,R)) ZS("next",rand(R)) ZS("chi",Rand_Chi_Square(4,R)) ZS("next",rand(R))
#local R=seed(7); ZS("fd",Rand_F_Dist(3,4,R)) ZS("next",rand(R))
#local R=seed(7); ZS("erl",Rand_Erlang(2,3,R)) ZS("next",rand(R))
#local R=seed(7); ZS("exp",Rand_Exp(2,R)) ZS("next",rand(R))
#local R=seed(7); ZS("logn",Rand_Lognormal(1,2,R)) ZS("next",rand(R))
#local R=seed(7); ZS("par",Rand_Pareto(2,R)) ZS("next",rand(R))
#local R=seed(7); ZS("wei",Rand_Weibull(2,3,R)) ZS("next",rand(R))
#local R=seed(7); ZS("bern",Rand_Bernoulli(.5,R)) ZS("next",rand(R)) ZS("prob",Prob(.5,R)) ZS("next",rand(R))
#local R=seed(7); ZS("bin",Rand_Binomial(5,.4,R)) ZS("next",rand(R))
#local R=seed(7); ZS("geo",Rand_Geo(.1,R)) ZS("next",rand(R))
#local R=seed(7); ZS("poi",Rand_Poisson(3,R)) ZS("next",rand(R))
#local R=seed(7); ZS("tri",Rand_Triangle(1,2,4,R)) ZS("next",rand(R)) ZS("tri",Rand_Triangle(1,4,2,R)) ZS("next",rand(R))
ZS("rdma",rand(RdmA)) ZS("rdmb",rand(RdmB))ZS("rdmc",rand(RdmC)) ZS("rdmd",rand(RdmD))
#local R=seed(3); #local I=0; #while(I<20) ZS("n",Rand_Normal(0,1,R)) ZS("g",Rand_Gauss(0,1,R)) ZS("ga",Rand_Gamma(.7,2,R))ZS("ga",Rand_Gamma(3.7,2,R)) ZS("be",Rand_Beta(.5,2,R)) ZS("p",Rand_Poisson(2.5,R)) ZS("st",Rand_Student(4,R)) ZS("geo",Rand_Geo(.3,R)) ZS("bi",Rand_Binomial(7,.3,R)) #local I=I+1; #end
