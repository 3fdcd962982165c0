#ifndef rhombicPictureSteps_h
#define rhombicPictureSteps_h

#include "rhombicColourScale.h"
#include "rhombicDicomCapture.h"
#include "rhombicNamePlaces.h"
#include "rhombicPictureIO.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicRenderPage.h"
#include "rhombicSheet.h"
#include "rhombicSurfaceMemory.h"
#include "rhombicSurfaceRenderer.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * The steps of RenderScan() and RenderSheet(): a scene is made, places of planes are found, planes drawn, and files
 * written beside pictures and pages. */

/** The surfaces that pictures show, with their scan, volumes and report. */
struct PictureScene
{
  std::vector<SceneSurface> surfaces;
  std::vector<LegendRow> rows;  ///< of the surfaces, in their order
  std::optional<Scan> scan;     ///< for greys; none without a scan, and when it was not to be kept
  SliceBox box;                 ///< of the scan or label map, else around the surfaces
  bool isOriented = true;       ///< whether it is known how the surfaces lie in the patient
  std::string examination;      ///< "CT chest", "PET", "Segmentation", "Scan" if nothing is known, "Surfaces" of files
  std::string thresholds;       ///< "bone from 250.5, skin from -300.5"; empty without isosurfaces
  std::string unit;             ///< of the scan's values: "HU", "Bq/ml"; empty if unknown
  std::string frameOfReference; ///< see DicomExamination
  std::vector<std::string> facts;                 ///< "scan: DICOM CT, 512 x 512 x 138, ...", and so on
  std::optional<ColourScale> scale;               ///< of the surfaces' points, if they are coloured by numbers
  std::vector<SceneSurface> drawnAsLines;         ///< other surfaces, of which pages show the outlines alone
  std::vector<std::string> headings;              ///< of LegendRow::figures on pages
  bool isForViews = false;                        ///< whether a surface has fewer triangles already, see SurfaceViewing
  std::shared_ptr<const SurfacesInFiles> inFiles; ///< where arrays are, also those of drawing; not null
  Report report;

  /** Of planes, by PlaneRequest::place, if they are not found from the surfaces. */
  std::map<std::string, Vector3> places;
};

/** CountDrawing of pictures as large as the settings say. \param areFewer whether surfaces are drawn in as few
 * triangles as their views need \param hasLabels which may become translucent */
std::uintmax_t
CheckDrawing(const RenderSettings & render,
             bool isTranslucent,
             bool areFewer,
             bool hasLabels,
             DrawnTriangles triangles);

/** What a scene is for. */
struct SceneUse
{
  CountDrawing countDrawing;
  std::optional<ColourBy> colourBy = std::nullopt;
  bool keepsScan = false;                 ///< whether the scan is needed when the surfaces are made
  std::vector<PlaneRequest> onlySlices{}; ///< if not empty, the scene is for these alone, and surfaces of labels may be
                                          ///< missing elsewhere
  std::optional<SurfaceViewing> viewing{}; ///< of surfaces that are only looked at
};

/** Reads a source, and makes its surfaces: in slabs where the lattice does not fit, and in temporary files where they
 * do not. Throws Failure. \param volume the scan's volume, if the caller has read the scan already */
PictureScene
MakePictureScene(const PictureSource & source,
                 std::optional<SourceVolume> volume,
                 const SceneUse & use,
                 const Events & events);

/** Plans the work of MakePictureScene(). */
std::string
PlanPictureScene(const PictureSource & source,
                 const std::filesystem::path & output,
                 const SceneUse & use,
                 const Events & events);

/** The box around surfaces, with a grid for slices where there is no scan. */
SliceBox
BoxOfSurfaces(const std::vector<SceneSurface> & surfaces);

/** The surfaces as they are drawn in views: those without normals, as of STL files, get normals for shading. */
std::vector<SceneSurface>
ShadedSurfaces(std::vector<SceneSurface> surfaces);

/** Surfaces in as few triangles as give the same pictures in several views (InFewerTriangles() within a quarter of a
 * pixel), unless points have colours. */
std::vector<SceneSurface>
FewerForViews(const std::vector<SceneSurface> & surfaces,
              const RenderSettings & render,
              const std::vector<View> & views);

/** ShadedSurfaces() of FewerForViews(). */
std::vector<SceneSurface>
SurfacesForViews(const std::vector<SceneSurface> & surfaces,
                 const RenderSettings & render,
                 const std::vector<View> & views);

/** Names of a scene's surfaces for a picture.
 * \param places in the view that the projection is of */
std::vector<PointedName>
NamesOf(const PictureScene & scene, const std::vector<NamePlace> & places, const Projection & projection);

/** The centre of a box. */
Vector3
CentreOf(const LPSBox & box);

/** The length of the longest side of a box. */
double
LongestSideOf(const LPSBox & box);

/** Adds the names of surfaces that planes go through to the needed names. */
void
NeedPlaces(const std::vector<PlaneRequest> & requests, SceneRules & rules);

/** The point of a plane. Throws Failure(Usage) for a place that no surface's name fits, and for a place outside the
 * scene.
 */
Vector3
FindPlace(const PlaneRequest & request, const PictureScene & scene);

/** The point of a plane that shows most surfaces: sections of a tenth of the surface's largest section and more. Of
 * several such planes the one with the largest sections in all, each as a share of its surface's largest; of planes
 * alike the one nearest to the middle of all surfaces. */
Vector3
PlaceOfMost(SlicePlane plane, const PictureScene & scene);

/** The points of a lightbox's slices, evenly along the axis of the plane, from head to feet, from front to back or from
 * the patient's left to right, as far as there are surfaces if their outlines are drawn. */
std::vector<Vector3>
PlacesInLightbox(const PlaneRequest & request, const SliceSettings & settings, const PictureScene & scene);

/** The surfaces whose names fit a pattern. Throws Failure(Usage), suggesting the nearest name, when there are none. */
std::vector<SceneSurface>
SurfacesNamed(const std::vector<SceneSurface> & surfaces, const std::string & pattern);

/** The planes that cut a scene. Throws Failure(Usage) for a plane that does not meet the scene. */
std::vector<ClipPlane>
ClipPlanesOf(const RenderScanSettings & settings, const PictureScene & source);

/** Adds pictures in a scene's clip planes, those of the settings: the greys of the scan inside the surfaces that are
 * cut, in their colours where there is no scan. */
void
AddCaps(const RenderScanSettings & settings, const PictureScene & source, Scene & scene);

/** The views of surfaces: those of the settings, or of a turntable. */
std::vector<View>
ViewsOf(const RenderScanSettings & settings);

/** Makes opaque surfaces translucent that hide others from every side (see FindEnclosing()) or cover others by their
 * names, as skin and fat do; with a note, and in the report. An opacity that was asked for stays. */
void
OpenEnclosing(const SurfaceSelection & selection,
              const std::vector<ClipPlane> & cuts,
              PictureScene & scene,
              const Events & events);

/** Of surfaces that are flat along an axis of the patient, the two standard views of their faces; otherwise none. Of
 * axial faces that from the feet comes first, as axial slices are seen. */
std::vector<View>
ViewsOfFaces(const std::vector<SceneSurface> & surfaces);

/** Chooses the view if none was asked for. With a focus, gives the settings' ghost opacity to surfaces that hide
 * the focus in one of the views; with a note, and in the report. An opacity that was asked for stays. */
void
ShowFocus(const std::vector<ClipPlane> & cuts,
          RenderScanSettings & settings,
          PictureScene & scene,
          const Events & events);

/** Sets the colours of the points of all surfaces, the scene's scale and its report; see the function of the same name
 * in rhombicColourBy.h. An only surface becomes opaque; a note warns of others that are translucent, whose colours are
 * mixed. Does nothing where surfaces keep their colours. */
void
ColourSurfaces(const PictureSettings & settings, PictureScene & scene, const Events & events);

/** Adds slices that stand in the scene. */
void
AddPlanes(const RenderScanSettings & settings, const PictureScene & source, Scene & scene);

/** A slice through a scene, which has no picture yet. */
struct SceneSlice
{
  SheetPicture picture;     ///< outlines in the colours of lines, background, caption and position
  std::vector<bool> isSeen; ///< whether the slice cuts a surface, in the order of the scene
};

/** Cuts a scene's surfaces. There are no outlines if the settings leave them out. */
SceneSlice
CutScene(const PictureScene & scene,
         const PlaneRequest & request,
         const Vector3 & point,
         const SliceSettings & settings);

/** Draws a slice between margins in a picture of so many pixels: the scan's greys, or without a scan the areas in the
 * surfaces in their colours, on the background; and moves the outlines there. */
void
DrawSceneSlice(const PictureScene & scene,
               const SliceSettings & settings,
               int width,
               int height,
               const Margins & margins,
               SheetPicture & slice);

/** Plans and draws the pages of a scene, and stages them with its report. Returns their pictures; of PDF only if they
 * are needed. */
std::vector<Picture>
StageScenePages(const RenderSheetSettings & settings,
                const PictureScene & scene,
                const std::vector<PlaneRequest> & planes,
                bool needsPictures,
                SurfaceRenderer & renderer,
                const Events & events,
                OutputFiles & outputs);

/** Draws the still pictures of a scene, makes its interactive page, and stages the page with the scene's report. The
 * scene is taken, so that its surfaces are freed while they are simplified. */
void
StageScenePage(const RenderPageSettings & settings,
               PictureScene scene,
               SurfaceRenderer & renderer,
               const Events & events,
               OutputFiles & outputs);

/** Height of a slice through the whole scene, divided by its width. */
double
AspectOfSlice(const PictureScene & scene, const PlaneRequest & request, const Vector3 & point);

/** A path with a part added to its stem. */
std::filesystem::path
WithPart(const std::filesystem::path & path, const std::string & part);

/** The DICOM files beside pictures, if any are written: with .dcm in place of their extensions. */
std::vector<std::filesystem::path>
DicomPathsOf(const PictureSettings & settings, std::vector<std::filesystem::path> pictures);

/** The study that DICOM files are added to; nothing without any. Throws Failure as DicomStudy does, and Usage for
 * surface files, and for a path in the scan's own folder. */
std::optional<DicomStudy>
OpenStudy(const PictureSource & source, const std::vector<std::filesystem::path> & dicomPaths);

/** Writes the thumbnail, the first picture with at most 320 pixels a side, made of means of blocks; and, if there is a
 * study, each picture as a DICOM file, or with one path all as the frames of one file. Throws Failure. */
void
StageFilesBeside(const std::vector<Picture> & pictures,
                 const PictureSettings & settings,
                 const std::optional<DicomStudy> & study,
                 const std::vector<std::filesystem::path> & dicomPaths,
                 double secondsPerFrame,
                 const Events & events,
                 OutputFiles & outputs);

} // namespace rhombic

#endif
