#ifndef rhombicFragmentLists_h
#define rhombicFragmentLists_h

#include <vtkOpenGLBufferObject.h>
#include <vtkShaderProgram.h>
#include <vtkSmartPointer.h>

#include <string>

namespace rhombic
{

/** A part of a picture in samples or pixels from the lower left. */
struct Viewport
{
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool
  operator==(const Viewport & other) const
  {
    return x == other.x && y == other.y && width == other.width && height == other.height;
  }
};

/** \class FragmentLists
 * \brief The translucent fragments of each sample in a part of the picture, in the memory of OpenGL. Triangles are
 * drawn once, in any order; then each sample's fragments are sorted.
 *
 * One linked list for each sample, after J. C. Yang, J. Hensley, H. Gruen and N. Thibieroz, "Real-Time Concurrent
 * Linked List Construction on the GPU", Computer Graphics Forum 29(4), 2010. */
class FragmentLists
{
public:
  /** The largest number of fragments: a sixteenth in each of 16 pools, which tiles of 64 x 64 samples share. Needs a
   * block of 64 MiB; OpenGL 4.3 promises 16 MiB, software and most graphics cards have 128 MiB and more. */
  static constexpr std::size_t Capacity = std::size_t{ 1 } << 22U;
  static constexpr std::size_t FragmentBytes = 16;

  /** Whether the current context has what lists need: OpenGL 4.3, and buffers of this size. */
  static bool
  AreSupported();

  /** Empty lists for a part of the picture, which programs fill from now on. */
  void
  Begin(const Viewport & part);

  /** Binds no buffers any more. Those that another program has bound at 0 and 1 before have to be bound again. */
  static void
  End();

  /** The number of fragments since Begin(), as if all pools had as many as the fullest. Where it is above
   * Capacity, some were not kept. */
  std::size_t
  NumberOfFragments() const;

  /** Tells a program where the lists of the part's samples are. */
  void
  SetUniforms(vtkShaderProgram * program) const;

private:
  Viewport m_Part;
  std::size_t m_Samples = 0;                          ///< that the buffer of firsts has room for
  vtkSmartPointer<vtkOpenGLBufferObject> m_Firsts;    ///< of each sample's list
  vtkSmartPointer<vtkOpenGLBufferObject> m_Fragments; ///< behind the numbers of those in each pool
};

/** GLSL: the lists, for both programs. */
extern const std::string ListsText;

/** GLSL: AddFragment(), which adds a fragment's colour to the list of its sample. */
extern const char * const AddFragmentText;

/** GLSL: a program for each sample, which blends the nearest 32 fragments from near to far, without those less than
 * 1e-6 of the depths behind another. Multiplied by alpha. */
extern const char * const BlendFragmentsText;

} // namespace rhombic

#endif
