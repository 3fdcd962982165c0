#ifndef rhombicSurfaceRenderer_h
#define rhombicSurfaceRenderer_h

#include "rhombicPicture.h"
#include "rhombicRenderBackend.h"
#include "rhombicScene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** \class SurfaceRenderer
 * \brief Draws surfaces as pictures, without a window and without an X server.
 *
 * The same scene and settings give the same bytes in every run on a machine, with any number of threads.
 *
 * Thread safety: create, use and destroy a renderer on one thread; several threads may each have their own, and take
 * turns while drawing.
 */
class SurfaceRenderer
{
public:
  /** Throws Failure(Display) when the backend does not work here. */
  explicit SurfaceRenderer(RenderBackend backend = RenderBackend::Automatic);
  ~SurfaceRenderer();

  SurfaceRenderer(const SurfaceRenderer &) = delete;
  SurfaceRenderer &
  operator=(const SurfaceRenderer &) = delete;

  /** The picture of all surfaces, as large as fits between the picture's margins. Surfaces without triangles are left
   * out. Surfaces that have no normals are drawn faceted. Translucent surfaces show their near walls only, more opaque
   * at their outlines, in the right order whatever the order of the list.
   *
   * Throws Failure: Empty when no surface has a triangle; Usage for a setting, colour or opacity out of range;
   * Memory, before any work, when EstimateMemory() is more than the settings allow, and when there is not enough after
   * all; Display when the graphics library reports an error. */
  Picture
  Render(const std::vector<SceneSurface> & scene, const RenderSettings & settings);

  /** Throws Failure(Usage) or Failure(Memory) when Render() would because of the settings: for asking before long work.
   * Memory is that for a scene without triangles.
   * \param isTranslucent whether the scene will have translucent surfaces, which take more memory */
  void
  CheckSettings(const RenderSettings & settings, bool isTranslucent = false) const;

  /** Most bytes that Render() takes at a time in software, with the picture that it returns, beside the surfaces. It
   * frees all but the picture and some 100 MiB of libraries before it returns. Thread safe. */
  static std::uintmax_t
  EstimateMemory(const std::vector<SceneSurface> & scene, const RenderSettings & settings);

  /** One line: backend, renderer and OpenGL version. */
  std::string
  GetBackendDescription() const;

  /** Tries every backend in the order of preference. Never throws for a backend that does not work. */
  static std::vector<BackendProbe>
  ProbeBackends();

private:
  class Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

} // namespace rhombic

#endif
