// @ts-check
// What the graphics processor runs behind the first picture. A ground's light and colours are painted once into a texture (PAINT), which
// each frame only looks up; contours are drawn by the frame, one pixel wide at any distance.

import { FLAT, HEAD } from './first_drawing.js';
import { STEEPEST } from './relief.js';

/** The sky at a place of the picture, 0 to 1. */
const SKY = `
uniform vec3 skyAbove, skyBelow, skyGlow;
vec3 sky(vec2 p){ vec2 q=(p-vec2(.5,.56))*vec2(1.,1.15); return mix(mix(skyBelow,skyAbove,smoothstep(0.,1.,p.y)),skyGlow,.85*exp(-dot(q,q)*5.)); }`;

/** Where the ground was only copied as a picture, its depths stand in a texture: what lies behind it is not drawn. */
const HIDE = `
uniform highp sampler2D depths; uniform float hides; bool isHidden(){ return hides>.5&&gl_FragCoord.z>texelFetch(depths,ivec2(gl_FragCoord.xy),0).r; }`;

const WHOLE = HEAD + `out vec2 t; void main(){ vec2 p=vec2(gl_VertexID&1,gl_VertexID>>1)*4.-1.; t=p*.5+.5; gl_Position=vec4(p,.999999,1); }`;


/** @type {Record<string, [string, string]>} */
export const SHADERS = {
  // on 16 x 10 tiles, between whose corners colours go over into one another; a raster hides the steps of 8 bits
  sky: [HEAD + SKY + `out vec3 c; void main(){ int k=gl_VertexID%6, n=gl_VertexID/6; vec2 p=(vec2(n%16,n/16)+vec2(k==1||k>2&&k<5?1:0,k==2||k>3?1:0))/vec2(16,10);
c=sky(p); gl_Position=vec4(p*2.-1.,.999999,1); }`,
  HEAD + 'in vec3 c; out vec4 o; void main(){ ivec2 p=ivec2(gl_FragCoord.xy); int k=p.x^p.y; o=vec4(c+(float((k&1)*8+(p.y&1)*4+(k&2)+(p.y&2)/2)/16.-.47)/255.,1); }'],

  // a picture of the same size, as it is: by a draw, which a processor shares out; its blit does not
  copy: [WHOLE, HEAD + 'uniform highp sampler2D picture; out vec4 o; void main(){ o=texelFetch(picture,ivec2(gl_FragCoord.xy),0); }'],

  // shape: z from 0 to 1, zx, zy; light: of sun and sky; ramps: height, below it slope
  paint: [WHOLE, HEAD + `in vec2 t; out vec4 o; uniform sampler2D shape,light,ramps;
uniform vec3 toSun; uniform vec2 points,metres; uniform float exaggeration,steep,slope,tile,open,sun,seam;
float rand(vec2 p){ vec3 q=fract(p.xyx*.1031); q+=dot(q,q.yzx+33.33); return fract((q.x+q.y)*q.z); }
float noise(vec2 p){ vec2 i=floor(p),f=p-i; f=f*f*(3.-2.*f); return mix(mix(rand(i),rand(i+vec2(1,0)),f.x),mix(rand(i+vec2(0,1)),rand(i+1.),f.x),f.y); }
void main(){ vec2 u=t*(points-1.)/points+.5/points, at=t*metres; vec3 s=texture(shape,u).rgb; vec2 l=texture(light,u).rg;
  float grade=length(s.yz), rough=noise(at*1.3)*.6+noise(at*5.3)*.4-.5;
  vec3 n=normalize(vec3(-s.yz*exaggeration+(1.-slope)*.10*vec2(noise(at*2.7)-.5,noise(at*2.7+50.)-.5),1));
  vec3 c=slope>.5?texture(ramps,vec2(clamp(grade/(steep*${STEEPEST}),0.,1.),.75)).rgb:texture(ramps,vec2(s.x,.25)).rgb;
  c*=c; c*=1.+.11*rough*(1.-slope);
  if(tile>0.){ vec2 k=at/tile; c*=mod(floor(k.x)+floor(k.y),2.)<.5?1.:.8; vec2 g=abs(fract(k+.5)-.5)*tile; c*=.8+.2*smoothstep(.0,.05*tile,min(g.x,g.y)); }
  float d=max(dot(n,toSun),0.)*l.r;
  vec3 lit=c*(vec3(.30,.38,.52)*(.3+.7*l.g)*(.72+.28*n.z)+vec3(1.18,1.06,.88)*d)*sun;
  vec2 e=min(at,metres-at); float rim=min(e.x,e.y);
  if(open>.5){ float w=.02*min(metres.x,metres.y); float k=smoothstep(w,w*.9,rim)*(.25+.75*step(.5,fract((at.x+at.y)/(2.*w)))); lit=mix(lit,vec3(.85,.33,.06)*(.35+.65*l.r),k*.8); }
  if(seam>.5) lit=mix(lit,vec3(.9),.3*smoothstep(.004,.002,rim/min(metres.x,metres.y))*step(.5,fract((at.x+at.y)*.5)));
  lit=min(lit,.66+.34*(1.-exp(-max(lit-.66,0.)/.34)));
  o=vec4(sqrt(lit),1); }`],

  ground: [HEAD + `layout(location=0) in vec3 p; uniform mat4 M; uniform vec4 domain; uniform vec2 offset,middle; uniform float exaggeration; out vec2 t,b; out float z,w;
void main(){ vec2 size=domain.zw-domain.xy; t=(p.xy-domain.xy)/size; z=p.z; b=(p.xy+offset-middle)/size; gl_Position=M*vec4(p.xy+offset,p.z*exaggeration,1); w=gl_Position.w; }`,
  HEAD + SKY + `in vec2 t,b; in float z,w; out vec4 o; uniform sampler2D painted; uniform vec2 size; uniform vec2 fade; uniform float interval,ink,far;
float line(float k,float f,float wide){ return clamp((1.2*wide-abs(fract(k)-.5)/f)/wide,0.,1.)*clamp((.4-f)*4.,0.,1.); }
void main(){ vec3 c=texture(painted,t).rgb;
  if(interval>0.){ float k=z/interval+.07, f=max(fwidth(k),1e-6); c*=mix(1.,ink,max(line(k,f,.8)*.5,line(k*.2+.4,f*.2,1.2))); }
  if(fade.y>0.){ float k=smoothstep(fade.x,fade.y,max(abs(b.x),abs(b.y))); if(k>.995) discard; c=mix(c,sky(gl_FragCoord.xy/size),k); }
  o=vec4(mix(c,skyGlow,clamp((w/far-1.)*.5,0.,.5)),1); }`],

  // p.w: how deep below the surface; the soil in layers
  soil: [HEAD + `layout(location=0) in vec4 p; layout(location=1) in float shade; uniform mat4 M; uniform float exaggeration; out vec4 q; out float s,w;
void main(){ q=p; s=shade; gl_Position=M*vec4(p.xy,p.z*exaggeration,1); w=gl_Position.w; }`,
  HEAD + `uniform vec3 skyGlow; in vec4 q; in float s,w; out vec4 o; uniform vec3 top,middle,bottom; uniform float thick,far;
void main(){ float along=q.x+q.y, d=q.w/thick+.02*sin(along*.9/thick*4.)+.012*sin(along*2.3/thick*4.+1.);
  vec3 c=mix(top,middle,smoothstep(.12,.3,d)); c=mix(c,bottom,smoothstep(.45,1.05,d));
  float k=fract(d*7.); c*=.93+.1*smoothstep(.05,.4,k)*smoothstep(1.,.6,k);
  c=mix(c*1.55,c,smoothstep(0.,.035,q.w/thick)); c*=s*(1.-.3*smoothstep(.5,1.4,d));
  o=vec4(mix(c,skyGlow,clamp((w/far-1.)*.5,0.,.5)),1); }`],

  // part: 0 plate, 1 leg, 2 feeler, 3 head, 4 eye; place.w: half its length [m]; forward.w: the walk's phase;
  // up.w: 1 a ghost, of which most is its outline; colour.w: the coat, 1 a dark head, 2 a belt, 3 both
  louse: [HEAD + `layout(location=0) in vec4 p; layout(location=1) in vec3 n; layout(location=2) in vec4 place; layout(location=3) in vec4 forward;
layout(location=4) in vec4 up; layout(location=5) in vec4 colour; uniform mat4 M; out vec3 N,W,c; out float along,part,ghost,coat;
void main(){ vec3 q=p.xyz; part=p.w; along=q.x; c=colour.rgb; ghost=up.w; coat=colour.w;
  if(part>.5&&part<1.5){ float s=sign(q.y), k=forward.w+q.x*4.6+s*1.5708, out_=smoothstep(.36,.8,abs(q.y)); q.x+=sin(k)*.11*out_; q.z+=max(cos(k),0.)*.09*out_; }
  if(part>1.5&&part<2.5) q.y+=.10*sin(forward.w*.31+q.y*6.)*(q.x-.8);
  mat3 R=mat3(forward.xyz,cross(up.xyz,forward.xyz),up.xyz); W=place.xyz+R*(q*place.w); N=R*n; gl_Position=M*vec4(W,1); }`,
  HEAD + HIDE + `in vec3 N,W,c; in float along,part,ghost,coat; out vec4 o; uniform vec3 toSun,eye; uniform float plain;
void main(){ if(isHidden()) discard; vec3 n=normalize(N), v=normalize(eye-W); float facing=max(dot(n,v),0.);
  if(ghost>.5){ float a=.24+.7*pow(1.-facing,1.5); o=vec4((c*.75+.25*step(.5,max(c.r,max(c.g,c.b))))*a,a); return; }
  vec3 k=c*c, head=vec3(mod(coat,2.)>.5?.006:.92); if(coat>1.5&&part<.5&&abs(along+.25)<.2) k=vec3(.006);
  if(part<.5){ float seg=fract((along+1.)*3.5); k=mix(k*.30,k,clamp(seg*7.,0.,1.)*clamp((1.-seg)*11.,0.,1.)); if(plain>.5) k=mix(k,head,clamp((along-.62)*14.,0.,1.)); }
  else if(part<2.5) k=k*.16+.01;
  else if(part<3.5) k=mix(k,head,.9);
  else k=vec3(.005);
  float d=max(dot(n,toSun),0.); float shine=max(dot(n,normalize(toSun+v)),0.), away=1.-facing; shine*=shine; shine*=shine; shine*=shine; shine*=shine*shine*shine*shine;
  vec3 lit=k*(vec3(.34,.40,.50)*(.6+.4*n.z)+vec3(1.12,1.04,.9)*d)+shine*(part<.5?.45:part>3.5?.8:0.)+k*.5*away*away*away;
  o=vec4(sqrt(clamp(lit,0.,1.)),1); }`],

  // as flat, of what nothing hides: of a first picture all

  flat: [FLAT, HEAD + HIDE + 'in vec4 c; out vec4 o; void main(){ if(isHidden()) discard; o=c; }'],
};
