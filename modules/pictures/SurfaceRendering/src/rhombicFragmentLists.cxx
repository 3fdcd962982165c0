#include "rhombicFragmentLists.h"

#include <vtk_glew.h>

#include <algorithm>
#include <array>

namespace rhombic
{
namespace
{

/** As the programs' layout. */
enum Binding : GLuint
{
  Firsts,
  Fragments
};

// Each thread of a software renderer draws a tile of its own, so that few threads count in the same pool.
constexpr std::size_t Pools = 16;
constexpr std::size_t NumbersOfLine = 16; // of the processor's cache, which threads share

/** The number of fragments of a pool is the first of its line. */
using PoolSizes = std::array<GLuint, Pools * NumbersOfLine>;

vtkSmartPointer<vtkOpenGLBufferObject>
MakeBuffer(std::size_t bytes)
{
  auto buffer = vtkSmartPointer<vtkOpenGLBufferObject>::New();
  buffer->GenerateBuffer(vtkOpenGLBufferObject::ArrayBuffer);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(buffer->GetHandle()));
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_COPY);
  return buffer;
}

void
Bind(const vtkOpenGLBufferObject & buffer, Binding binding)
{
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, static_cast<GLuint>(buffer.GetHandle()));
}

} // namespace

bool
FragmentLists::AreSupported()
{
  GLint major = 0;
  GLint minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  if (10 * major + minor < 43 || !GLEW_VERSION_4_3) // GLEW may have looked in an older context
  {
    return false;
  }
  GLint64 bytes = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
  return bytes >= static_cast<GLint64>(sizeof(PoolSizes) + Capacity * FragmentBytes);
}

void
FragmentLists::Begin(const Viewport & part)
{
  m_Part = part;
  const auto samples = static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height);
  if (samples > m_Samples)
  {
    m_Firsts = nullptr; // before there is room for more
    m_Firsts = MakeBuffer(samples * sizeof(GLuint));
    m_Samples = samples;
  }
  if (!m_Fragments)
  {
    m_Fragments = MakeBuffer(sizeof(PoolSizes) + Capacity * FragmentBytes);
  }
  constexpr GLuint none = 0;
  Bind(*m_Firsts, Firsts);
  glClearBufferSubData(GL_SHADER_STORAGE_BUFFER,
                       GL_R32UI,
                       0,
                       static_cast<GLsizeiptr>(samples * sizeof none),
                       GL_RED_INTEGER,
                       GL_UNSIGNED_INT,
                       &none);
  Bind(*m_Fragments, Fragments);
  const PoolSizes sizes{};
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof sizes, sizes.data());
}

std::size_t
FragmentLists::NumberOfFragments() const
{
  PoolSizes sizes{};
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  Bind(*m_Fragments, Fragments);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof sizes, sizes.data());
  return Pools * static_cast<std::size_t>(*std::max_element(sizes.begin(), sizes.end()));
}

void
FragmentLists::End()
{
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, Firsts, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, Fragments, 0);
}

void
FragmentLists::SetUniforms(vtkShaderProgram * program) const
{
  const std::array<int, 2> first{ m_Part.x, m_Part.y };
  program->SetUniform2i("firstSample", first.data());
  program->SetUniformi("samplesOfRow", m_Part.width);
}

const std::string ListsText = "#define POOLS " + std::to_string(Pools) + "\n#define LINE " +
                              std::to_string(NumbersOfLine) + "\n#define FRAGMENTS " +
                              std::to_string(FragmentLists::Capacity / Pools) + R"(
struct Fragment
{
  uint next;  // number of a fragment of the same sample, 0: none
  uint depth; // bits of a float that is not negative, which have the order of the floats
  uint actor;
  uint colour;
};

layout(std430, binding = 0) buffer Firsts
{
  uint firsts[]; // of each sample's list, 0: none
};

layout(std430, binding = 1) buffer Fragments
{
  uint sizes[POOLS * LINE];
  Fragment fragments[];       // from number 1
};

uniform ivec2 firstSample; // of this part of the picture
uniform int samplesOfRow;

int Sample()
{
  ivec2 at = ivec2(gl_FragCoord.xy) - firstSample;
  return at.y * samplesOfRow + at.x;
}
)";

const char * const AddFragmentText = R"(
layout(early_fragment_tests) in;
uniform int actor;

void AddFragment(vec4 colour)
{
  ivec2 tile = ivec2(gl_FragCoord.xy) / 64;
  uint pool = uint(tile.x + 5 * tile.y) % uint(POOLS);
  uint number = atomicAdd(sizes[pool * uint(LINE)], 1u);
  if (number < uint(FRAGMENTS))
  {
    number += pool * uint(FRAGMENTS);
    fragments[number].next = atomicExchange(firsts[Sample()], number + 1u);
    fragments[number].depth = floatBitsToUint(gl_FragCoord.z);
    fragments[number].actor = uint(actor);
    fragments[number].colour = packUnorm4x8(colour);
  }
}
)";

const char * const BlendFragmentsText = R"(
// Whether a is seen before b: depth, actor and colour. Of fragments in one place, that of the first actor is seen.
bool IsBefore(uvec3 a, uvec3 b)
{
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// The next fragment is searched for, not sorted in an array, as software of Mesa 22.3 loses elements that are moved within an array.
void main()
{
  uint first = firsts[Sample()];
  vec4 sum = vec4(0.0);
  float depth = 0.0;
  for (int layer = 0; layer < 32; ++layer)
  {
    uvec3 nearest = uvec3(0xffffffffu);
    for (uint number = first; number != 0u; number = fragments[number - 1u].next)
    {
      Fragment fragment = fragments[number - 1u];
      uvec3 found = uvec3(fragment.depth, fragment.actor, fragment.colour);
      if (uintBitsToFloat(found.x) > depth + 1e-6 && IsBefore(found, nearest))
      {
        nearest = found;
      }
    }
    if (nearest.x == 0xffffffffu)
    {
      break;
    }
    depth = uintBitsToFloat(nearest.x);
    vec4 colour = unpackUnorm4x8(nearest.z);
    sum += (1.0 - sum.a) * vec4(colour.rgb * colour.a, colour.a);
  }
  gl_FragData[0] = sum;
}
)";

} // namespace rhombic
