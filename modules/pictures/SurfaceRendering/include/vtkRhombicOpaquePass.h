#ifndef vtkRhombicOpaquePass_h
#define vtkRhombicOpaquePass_h

#include <vtkRenderPass.h>

#include <memory>

class vtkRhombicTranslucentPass;

/**
 * @class vtkRhombicOpaquePass
 * @brief Draws opaque surfaces with several samples for each pixel, cavities darkened and outlines drawn.
 *
 * This pass draws actors of triangles, polygons or strips: their points, normals (of points, else of cells, else none:
 * faceted), matrix, colour, back-face property, culling, mapped scalars and up to six clipping planes. All other opaque
 * props are drawn by OtherPass, before the surfaces: actors with lines, vertices, edges, textures, programs of their
 * own, physically based interpolation or a matrix that can't be inverted, subclasses of vtkActor, assemblies, image
 * slices.
 *
 * Of surfaces in one place that one is seen whose mapper has the smallest relative polygon offset
 * (vtkMapper::SetRelativeCoincidentTopologyPolygonOffsetParameters()): its units, and of surfaces with normals of
 * points its factor times the slope, the tangent of the angle between normal and view, up to SteepestSlope. Other
 * settings of coincident topology have no effect.
 *
 * The surfaces are hidden by what the framebuffer holds in front of them. Colours and depths end in the framebuffer, so
 * that other passes may follow. Triangles are uploaded when the polydata, the mapped scalars or the property have
 * changed, and kept between pictures. During a hardware selection OtherPass draws all props.
 *
 * The lights are those of the renderer, as VTK lights surfaces, or one of two sets that go with the camera. With these,
 * only the property's diffuse colour and specular strength count.
 *
 * A pass serves one render window at a time. A pass that is taken from its renderer keeps what it has uploaded until it
 * is deleted or draws in another window: call ReleaseGraphicsResources() before that window is finalized, as for VTK's
 * passes. Not thread safe.
 *
 * @sa vtkRhombicTranslucentPass vtkRhombicSurfacePass
 */
class vtkRhombicOpaquePass : public vtkRenderPass
{
public:
  static vtkRhombicOpaquePass *
  New();
  vtkTypeMacro(vtkRhombicOpaquePass, vtkRenderPass);
  void
  PrintSelf(ostream & os, vtkIndent indent) override;

  void
  Render(const vtkRenderState * state) override;

  void
  ReleaseGraphicsResources(vtkWindow * window) override;

  /** Of a unit of relative polygon offset, in OpenGL's depths, -1 to 1: some times the rounding errors of 32 bits, less
   * than 0.001 mm in 500 mm. */
  static constexpr double OffsetUnit = 2e-6;

  /** The largest slope by which relative polygon offsets grow. */
  static constexpr int SteepestSlope = 5;

  /** Lights of surfaces. */
  enum LightType
  {
    RendererLights, ///< the lights of the vtkRenderer
    ClinicLights,   ///< strong light from one side, for black backgrounds
    PaperLights     ///< soft light, for white backgrounds
  };

  ///@{
  /** Which lights surfaces have. The default is RendererLights. */
  vtkSetClampMacro(Lights, int, RendererLights, PaperLights);
  vtkGetMacro(Lights, int);
  ///@}

  ///@{
  /** Number of samples along each side of a pixel, 1 to 4. The default is 2: four samples for each pixel. */
  vtkSetClampMacro(Samples, int, 1, 4);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /** Whether cavities are darkened. The default is true. */
  vtkSetMacro(AmbientOcclusion, bool);
  vtkGetMacro(AmbientOcclusion, bool);
  vtkBooleanMacro(AmbientOcclusion, bool);
  ///@}

  ///@{
  /** Whether outlines are dark lines. The default is true. */
  vtkSetMacro(Silhouettes, bool);
  vtkGetMacro(Silhouettes, bool);
  vtkBooleanMacro(Silhouettes, bool);
  ///@}

  ///@{
  /** Whether surfaces leave straight colours in the framebuffer over a background without alpha, as files of pictures
   * have them, instead of colours multiplied by alpha, as passes that blend afterwards need them. The default is false.
   */
  vtkSetMacro(StraightAlpha, bool);
  vtkGetMacro(StraightAlpha, bool);
  vtkBooleanMacro(StraightAlpha, bool);
  ///@}

  ///@{
  /** Draws the opaque props that this pass does not draw; a vtkOpaquePass by default. May be null. */
  void
  SetOtherPass(vtkRenderPass * pass);
  vtkGetObjectMacro(OtherPass, vtkRenderPass);
  ///@}

protected:
  vtkRhombicOpaquePass();
  ~vtkRhombicOpaquePass() override;

  int Lights = RendererLights;
  int Samples = 2;
  bool AmbientOcclusion = true;
  bool Silhouettes = true;
  bool StraightAlpha = false;
  vtkRenderPass * OtherPass = nullptr;

private:
  friend class vtkRhombicTranslucentPass;

  vtkRhombicOpaquePass(const vtkRhombicOpaquePass &) = delete;
  void
  operator=(const vtkRhombicOpaquePass &) = delete;

  struct Parts;
  const std::unique_ptr<Parts> Internals;
};

#endif
