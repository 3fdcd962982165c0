#include "rhombicShaders.h"

#include "rhombicFragmentLists.h"
#include "vtkRhombicOpaquePass.h"

namespace rhombic
{
namespace
{

constexpr const char * SurfaceVertex = R"(
in vec3 point;
#if SMOOTH
in vec3 normal;
out vec3 direction;
#endif
#if PICTURE
in vec2 place;
out vec2 texturePlace;
#endif
#if COLOURS
in vec4 pointColour;
out vec4 mappedColour;
#endif
out vec3 position;
uniform vec3 centre;
uniform mat4 clipFromCentred;
uniform mat4 viewFromCentred;
uniform vec2 backward; // moves depths, so that of two surfaces in one place the first is seen: by so much, and times the slope
uniform mat3 viewFromNormal; // x right, y up, z towards the viewer
#if CUTS
uniform vec4 cuts[CUTS];
out float gl_ClipDistance[CUTS];
#endif

void main()
{
  vec3 centred = point - centre;
  gl_Position = clipFromCentred * vec4(centred, 1.0);
  position = (viewFromCentred * vec4(centred, 1.0)).xyz;
#if PICTURE
  texturePlace = place;
#endif
  float slope = 0.0;
#if SMOOTH
  direction = viewFromNormal * normal;
  slope = min(length(direction.xy) / max(abs(direction.z), 1e-6), float(STEEPEST));
#endif
  gl_Position.z += (backward.x + backward.y * slope) * gl_Position.w;
#if COLOURS
  mappedColour = pointColour;
#endif
#if CUTS
  for (int n = 0; n < CUTS; ++n)
  {
    gl_ClipDistance[n] = dot(cuts[n], vec4(centred, 1.0));
  }
#endif
}
)";

constexpr const char * LitByOwnLight = R"(
#define KNEE 0.8
uniform vec4 light; // strength of key, fill, sky and rim
uniform vec2 shine; // strength of wide and narrow highlights

// The key light comes from the top left, the fill light from the right, the sky's from above, the rim's from behind.
vec3 Lit(vec3 colour, vec3 normal)
{
  float key = max(0.0, 0.8 * dot(normal, vec3(-0.339, 0.565, 0.753)) + 0.2);
  float fill = max(0.0, 0.7 * dot(normal, vec3(0.645, -0.242, 0.725)) + 0.3);
  float rim = 1.0 - clamp(normal.z, 0.0, 1.0);
  float halfway = max(0.0, dot(normal, vec3(-0.181, 0.302, 0.936)));
  halfway *= halfway;
  halfway *= halfway;
  halfway *= halfway;
  float wide = halfway * halfway;
  float narrow = wide * wide * wide * wide;
  vec3 lit = colour * (light.x * key + light.y * fill + light.z * (1.0 + 0.3 * normal.y) + light.w * rim * rim) +
    shine.x * wide + shine.y * narrow;
  // From KNEE on, the strongest channel m follows 1 - (1 - KNEE)^2 / (m + 1 - 2 KNEE), which begins with the same slope
  // and never reaches 1: white surfaces keep their relief, and all colours their hue.
  float strongest = max(max(lit.r, lit.g), max(lit.b, KNEE));
  return lit * ((1.0 - (1.0 - KNEE) * (1.0 - KNEE) / (strongest + 1.0 - 2.0 * KNEE)) / strongest);
}
)";

constexpr const char * SurfaceFragment = R"(
#if SMOOTH
in vec3 direction;
#endif
#if COLOURS
in vec4 mappedColour;
#endif
uniform float handedness;
uniform vec4 colours[2]; // of fronts and backs; opaque: alpha is the surface's number

void main()
{
  int side = gl_FrontFacing ? 0 : 1;
#if SMOOTH
  vec3 normal = normalize(direction);
  normal = gl_FrontFacing ? normal : -normal;
#else
  vec3 normal = handedness * normalize(cross(dFdx(position), dFdy(position))); // towards the viewer
#endif
  vec4 colour = colours[side];
#if COLOURS
  colour.rgb = mappedColour.rgb;
#if TRANSLUCENT
  colour.a *= mappedColour.a;
#endif
#endif
#if LIGHTS
  colour.rgb = LitByRenderer(colour.rgb, normal, side);
#else
#if TRANSLUCENT
  // See vtkRhombicTranslucentPass.
  float least = max(colour.a, 0.25);
  float exponent = max(2.0, 0.5 * sqrt(16.0 / least - 7.0) - 1.5);
  float facing = max(0.5 * least, 1.2 * least - 0.2);
  colour.a *= mix(pow(1.0 - min(abs(normal.z), 1.0), exponent), 1.0, facing) / least;
#endif
  colour.rgb = Lit(gl_FrontFacing ? colour.rgb : 0.85 * colour.rgb, normal);
#endif
#if TRANSLUCENT
  AddFragment(colour);
#else
  gl_FragData[0] = colour;
#endif
}
)";

/** Lights surfaces as vtkOpenGLPolyDataMapper does. */
std::string
RendererLight(const RendererLights & lights)
{
  std::string sum;
  for (int n = 0; n < lights.count; ++n)
  {
    const std::string number = std::to_string(n);
    const std::string direction = "lightDirectionVC" + number;
    if (lights.complexity < 3)
    {
      sum += "  AddLight(lightColor" + number + ", " + (lights.complexity == 1 ? "vec3(0.0, 0.0, -1.0)" : direction) +
             ", normal, side, diffuse, specular);\n";
      continue;
    }
    sum += "  if (lightPositional" + number + " == 0)\n  {\n    AddLight(lightColor" + number + ", " + direction +
           ", normal, side, diffuse, specular);\n  }\n  else\n  {\n    vec3 way = position - lightPositionVC" + number +
           ";\n    float apart = length(way);\n    way /= apart;\n    float share = 1.0 / dot(lightAttenuation" +
           number + ", vec3(1.0, apart, apart * apart));\n    if (lightConeAngle" + number +
           " <= 90.0)\n    {\n      float inCone = dot(way, " + direction +
           ");\n      share = inCone >= cos(radians(lightConeAngle" + number +
           ")) ? share * pow(inCone, lightExponent" + number + ") : 0.0;\n    }\n    AddLight(share * lightColor" +
           number + ", way, normal, side, diffuse, specular);\n  }\n";
  }
  const std::string uniforms = R"(
uniform vec3 ambients[2]; // strengths of fronts and backs, and next
uniform vec3 diffuses[2];
uniform vec4 speculars[2]; // alpha: the power
uniform bool ambientIsMapped; // multiplies the colour; otherwise the ambient strength has its colour
uniform bool isLit;

void AddLight(vec3 strength, vec3 way, vec3 normal, int side, inout vec3 diffuse, inout vec3 specular)
{
  float facing = max(0.0, dot(normal, -way));
  diffuse += facing * strength;
)";
  const std::string highlight = lights.complexity == 1
                                  ? "  specular += pow(facing, speculars[side].a) * strength;\n}\n"
                                  : "  float mirrored = max(0.0, dot(reflect(way, normal), normalize(-position)));\n"
                                    "  specular += sign(facing) * pow(mirrored, speculars[side].a) * strength;\n}\n";
  return lights.declarations + uniforms + highlight + R"(
vec3 LitByRenderer(vec3 colour, vec3 normal, int side)
{
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
)" + sum +
         R"(
  vec3 ambient = ambients[side] * (ambientIsMapped ? colour : vec3(1.0));
  return isLit ? ambient + diffuse * diffuses[side] * colour + specular * speculars[side].rgb
               : ambient + diffuses[side] * colour;
}
)";
}

constexpr const char * PictureFragment = R"(
in vec2 texturePlace;
uniform float opacity;
uniform sampler2D picture;

vec4 Texel(ivec2 at)
{
  vec4 texel = texelFetch(picture, clamp(at, ivec2(0), textureSize(picture, 0) - 1), 0);
  return vec4(texel.rgb * texel.a, texel.a);
}

// The bilinear mean, in which transparent pixels do not count for the colour.
void main()
{
  vec2 position = texturePlace * vec2(textureSize(picture, 0)) - 0.5;
  ivec2 at = ivec2(floor(position));
  vec2 share = position - vec2(at);
  vec4 mean = mix(mix(Texel(at), Texel(at + ivec2(1, 0)), share.x),
                  mix(Texel(at + ivec2(0, 1)), Texel(at + ivec2(1, 1)), share.x),
                  share.y);
  if (mean.a < 0.002)
  {
    discard;
  }
  AddFragment(vec4(mean.rgb / mean.a, opacity * mean.a));
}
)";

ShaderDefines
DefinesOf(const SurfaceProgram & program)
{
  return { { "SMOOTH", program.isSmooth },
           { "TRANSLUCENT", program.isTranslucent },
           { "PICTURE", program.isPicture },
           { "COLOURS", program.hasColours },
           { "LIGHTS", program.light == SurfaceLight::Renderer },
           { "STEEPEST", vtkRhombicOpaquePass::SteepestSlope },
           { "CUTS", program.cuts } };
}

// VTK replaces these comments.
constexpr const char * VersionOfVTK = "//VTK::System::Dec\n";
const std::string OutputOfVTK = "//VTK::Output::Dec\n";

std::string
WholeProgram(const std::string & begin, const std::string & text, const ShaderDefines & defines)
{
  std::string program = begin;
  for (const auto & [name, value] : defines)
  {
    program += "#define " + name + ' ' + std::to_string(value) + '\n';
  }
  return program + text;
}

} // namespace

const char * const WholeTargetVertex = R"(
void main()
{
  gl_Position = vec4(float(gl_VertexID % 2) * 4.0 - 1.0, float(gl_VertexID / 2) * 4.0 - 1.0, 0.0, 1.0);
}
)";

const char * const NoSurfaceFragment = R"(
uniform sampler2D depths;

void main()
{
  gl_FragData[0] = vec4(0.0);
  gl_FragDepth = texelFetch(depths, ivec2(gl_FragCoord.xy) / SAMPLES, 0).r;
}
)";

const char * const ChangedFragment = R"(
uniform sampler2D depthsNow;
uniform sampler2D depthsWritten;

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy) / SAMPLES;
  float depth = texelFetch(depthsNow, at, 0).r;
  if (depth == texelFetch(depthsWritten, at, 0).r)
  {
    discard;
  }
  gl_FragData[0] = vec4(0.0);
  gl_FragDepth = depth;
}
)";

const char * const ReliefFragment = R"(
uniform sampler2D depths;
uniform sampler2D colours;
uniform vec3 depthRule; // offset, factor and spread of Camera

void main()
{
  ivec2 sampled = ivec2(gl_FragCoord.xy) * SAMPLES + SAMPLES / 2;
  float device = 2.0 * texelFetch(depths, sampled, 0).r - 1.0;
  float depth = (device - depthRule.x) / (depthRule.y - device * depthRule.z);
  gl_FragData[0] = vec4(depth, texelFetch(colours, sampled, 0).a, 0.0, 0.0);
}
)";

const char * const ShadeFragment = R"(
uniform sampler2D relief;
uniform vec2 pixelRule; // a pixel's size at depth 0 and the spread of Camera
uniform float reach;    // largest distance of surfaces that take light away
uniform float detail;   // pits up to this depth take no light away
uniform float jump;     // smallest step of depth that is an outline
uniform int line;       // width of an outline in pixels
uniform vec4 pairs[PAIRS]; // x, y: a point in the ball seen from the front, z: half the ball's depth there; of radius w

bool IsInside(ivec2 at)
{
  return at == clamp(at, ivec2(0), textureSize(relief, 0) - 1);
}

float Behind(ivec2 at, float depth)
{
  vec2 there = texelFetch(relief, clamp(at, ivec2(0), textureSize(relief, 0) - 1), 0).rg;
  return there.g == 0.0 ? 1e6 : there.r - depth;
}

float Filled(float behind, float halfDepth, float radius)
{
  return clamp(-behind / halfDepth, -1.0, 1.0) * clamp(2.5 + behind / radius, 0.0, 1.0);
}

// How far the surface lies below the chord between the points on both sides.
float Sunk(float after, float before, float apart)
{
  return -0.5 * (after + before) / length(vec2(1.0, 0.5 * (after - before) / apart));
}

float Taken(ivec2 at, float depth, float pixel)
{
  float turn = 0.3927 * float((at.x & 3) * 4 + ((at.y & 3) ^ (at.x & 1) * 2)); // 16 angles in each 4 x 4 pixels
  mat2 rotation = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  float sum = 0.0;
  for (int n = 0; n < PAIRS; ++n)
  {
    float radius = max(reach * pairs[n].w, 4.0 * detail);
    ivec2 offset = ivec2(round(rotation * pairs[n].xy * (radius / pixel)));
    float halfDepth = radius * pairs[n].z;
    float after = Behind(at + offset, depth);
    float before = Behind(at - offset, depth);
    float filled = max(0.0, Filled(after, halfDepth, radius) + Filled(before, halfDepth, radius));
    filled *= smoothstep(detail, 2.0 * detail, Sunk(after, before, length(pairs[n].xy) * radius));
    sum += IsInside(at + offset) && IsInside(at - offset) ? filled : 0.0;
  }
  return sum / float(PAIRS);
}

// How much the depth jumps beyond a pixel, in one direction and in the opposite one: by more than the slopes on both
// sides of the jump explain.
float Jump(ivec2 at, ivec2 offset, float depth)
{
  float after = min(Behind(at + offset, depth), 1e5);
  float before = min(Behind(at - offset, depth), 1e5);
  float farAfter = min(Behind(at + 2 * offset, depth), 1e5) - after;
  float farBefore = min(Behind(at - 2 * offset, depth), 1e5) - before;
  return max(after - max(0.0, max(farAfter, -before)), before - max(0.0, max(farBefore, -after)));
}

float Outline(ivec2 at, float depth, float pixel)
{
  float least = max(jump, 2.0 * float(line) * pixel);
  float most = max(max(Jump(at, ivec2(line, 0), depth), Jump(at, ivec2(0, line), depth)),
                   max(Jump(at, ivec2(line, line), depth), Jump(at, ivec2(line, -line), depth)));
  return smoothstep(least, 2.0 * least, most);
}

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 here = texelFetch(relief, at, 0).rg;
  float pixel = pixelRule.x * (1.0 + pixelRule.y * here.r);
  vec2 shade = vec2(0.0);
  if (here.g > 0.0)
  {
#if OCCLUSION
    shade.r = Taken(at, here.r, pixel);
#endif
#if OUTLINES
    shade.g = Outline(at, here.r, pixel);
#endif
  }
  gl_FragData[0] = vec4(shade, 0.0, 1.0);
}
)";

const char * const PixelFragment = R"(
uniform sampler2D colours;
uniform sampler2D behind;
uniform ivec2 origin; // of the viewport
#if DEPTHS
uniform sampler2D depths;
#endif
#if CHANGED
uniform sampler2D now;
uniform sampler2D depthsNow;
uniform sampler2D depthsWritten;
#endif
#if LAYERS
uniform sampler2D layers;
#endif
#if RELIEF
uniform sampler2D relief;
uniform sampler2D shades;
uniform float alike;    // difference of depth within one surface
uniform vec2 strengths; // of ambient occlusion and outlines

// The mean of the 16 pixels around that have different angles, without other surfaces; and of 9 pixels for outlines.
vec2 Shade(ivec2 at)
{
  ivec2 last = textureSize(relief, 0) - 1;
  vec2 here = texelFetch(relief, at, 0).rg;
  float taken = 0.0;
  float count = 0.0;
  float outline = 0.0;
  for (int y = -2; y < 2; ++y)
  {
    for (int x = -2; x < 2; ++x)
    {
      ivec2 beside = clamp(at + ivec2(x, y), ivec2(0), last);
      vec2 there = texelFetch(relief, beside, 0).rg;
      float counts = there.g > 0.0 && (here.g == 0.0 || abs(there.r - here.r) < alike) ? 1.0 : 0.0;
      taken += counts * texelFetch(shades, beside, 0).r;
      count += counts;
    }
  }
  for (int y = -1; y < 2; ++y)
  {
    for (int x = -1; x < 2; ++x)
    {
      ivec2 beside = clamp(at + ivec2(x, y), ivec2(0), last);
      outline += texelFetch(shades, beside, 0).g * float((2 - abs(x)) * (2 - abs(y))) / 16.0;
    }
  }
  return vec2(1.0 - min(strengths.x * taken / max(count, 1.0), 0.75), 1.0 - strengths.y * outline);
}
#endif

void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy) - origin;
  float bright = 1.0;
#if RELIEF
  vec2 shade = Shade(at);
  bright = shade.x * shade.y;
#endif
  vec4 background = texelFetch(behind, at, 0);
#if CHANGED
  background = texelFetch(depthsNow, at, 0).r == texelFetch(depthsWritten, at, 0).r ? background : texelFetch(now, at, 0);
#endif
  vec4 sum = vec4(0.0);
  for (int y = 0; y < SAMPLES; ++y)
  {
    for (int x = 0; x < SAMPLES; ++x)
    {
      vec4 colour = texelFetch(colours, at * SAMPLES + ivec2(x, y), 0);
      colour = colour.a > 0.0 ? vec4(colour.rgb * bright, 1.0) : background;
#if LAYERS
      vec4 layer = texelFetch(layers, at * SAMPLES + ivec2(x, y), 0);
      colour = layer + (1.0 - layer.a) * colour;
#endif
      sum += colour;
    }
  }
#if STRAIGHT
  sum.rgb *= sum.a > 0.0 ? float(SAMPLES * SAMPLES) / sum.a : 0.0;
#endif
  gl_FragData[0] = sum / float(SAMPLES * SAMPLES);
#if DEPTHS
  gl_FragDepth = texelFetch(depths, at * SAMPLES + SAMPLES / 2, 0).r;
#endif
}
)";

std::string
VertexShader(const std::string & text, const ShaderDefines & defines)
{
  return WholeProgram(VersionOfVTK, text, defines);
}

std::string
FragmentShader(const std::string & text, const ShaderDefines & defines)
{
  return WholeProgram(VersionOfVTK, OutputOfVTK + text, defines);
}

std::string
ListShader(const std::string & text, const ShaderDefines & defines)
{
  return WholeProgram("#version 430\n", ListsText + OutputOfVTK + text, defines);
}

std::string
SurfaceVertexShader(const SurfaceProgram & program)
{
  return VertexShader(SurfaceVertex, DefinesOf(program));
}

std::string
SurfaceFragmentShader(const SurfaceProgram & program, const RendererLights & lights)
{
  const std::string light = program.light == SurfaceLight::Own ? LitByOwnLight : RendererLight(lights);
  const std::string text = program.isPicture ? PictureFragment : "in vec3 position;\n" + light + SurfaceFragment;
  return program.isTranslucent ? ListShader(AddFragmentText + text, DefinesOf(program))
                               : FragmentShader(text, DefinesOf(program));
}

} // namespace rhombic
