#ifndef rhombicRenderScan_h
#define rhombicRenderScan_h

#include "rhombicColourBy.h"
#include "rhombicEvents.h"
#include "rhombicScanSource.h"
#include "rhombicScene.h"
#include "rhombicSidecar.h"
#include "rhombicSlicePlane.h"
#include "rhombicSurfaceFinish.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** The source of pictures: surfaces of a scan, or surface files. */
struct PictureSource
{
  ScanSource scan; ///< without effect if there are surface files
  SurfaceSelection surfaces;
  SurfaceFinish finish;                            ///< of each surface; combined with that of its preset
  std::vector<std::filesystem::path> surfaceFiles; ///< files that ReadSurfaces() reads
};

/** A plane at right angles to an axis of the patient, through a place that is known once there are surfaces. */
struct PlaneRequest
{
  SlicePlane plane = SlicePlane::Axial;
  std::string place; ///< "12.5": mm along the axis in LPS; "#40": a slice of voxels, from 0; empty: the middle of the
                     ///< scene; else the centroid of the surfaces whose names fit this pattern (see FitsPattern())
};

/** A plane, and the side of it that is removed. */
struct CutRequest
{
  PlaneRequest plane;
  bool removesHigher = true; ///< the side of larger coordinates in LPS
};

/** Throws Failure(Usage) for a slice that a scan does not have and a position outside of it. The scan needs no voxels.
 */
void
CheckPlaces(const std::vector<PlaneRequest> & requests, const Scan & scan);

/** A plane written as axial, coronal=liver, sagittal=-12.5 or axial=#40. Throws Failure(Usage). */
PlaneRequest
ParsePlaneRequest(const std::string & text);

/** A cut written as a plane, or as x>12, y<-30, z>100 in LPS mm for what is removed. Of planes, what lies above
 * (axial), in front (coronal) or to the patient's left (sagittal) is removed. Throws Failure(Usage). */
CutRequest
ParseCutRequest(const std::string & text);

/** Letters, lines and texts over pictures. */
struct AnnotationSettings
{
  bool letters = true;   ///< the anatomical directions at the edges
  bool scaleBar = true;  ///< in mm or cm; not in perspective
  bool legend = true;    ///< names and volumes, if there are two surfaces or more
  bool figure = false;   ///< a small human figure as the view sees it
  bool names = false;    ///< of surfaces that are seen, beside views, with lines to them; not in perspective
  std::string title;     ///< above the picture
  bool footnote = false; ///< thresholds, lattice and version, below the picture
};

/** How slices of the scan are drawn. */
struct SliceSettings
{
  std::string window = "auto"; ///< as WindowFromText() takes it
  SliceConvention convention = SliceConvention::Radiological;
  bool outlines = true;     ///< of the surfaces
  std::size_t lightbox = 0; ///< so many slices evenly along each plane's axis in one picture, instead of one slice
};

/** The settings that pictures and pages share. */
struct PictureSettings
{
  PictureSource source;
  std::vector<PlaneRequest> slices; ///< pictures of slices; of a page up to 3, and without any: axial, coronal and
                                    ///< sagittal; those without a place meet most surfaces
  SliceSettings slice;
  bool choosesViews = false; ///< no view was asked for: with a focus, the one standard view in which the smallest
                             ///< share of the focus is hidden, but none along it; of surfaces that are flat, as
                             ///< those of a few slices, views of their faces
  bool writesDicom = false;  ///< also writes each picture or page as DICOM, .dcm in place of the extension (see
                             ///< DicomStudy); a turntable is one file
  std::optional<ColourBy> colourBy; ///< of the surfaces in views, in place of their colours; with a bar of colours, of
                                    ///< pictures in place of the legend, without light and shadows
  std::filesystem::path thumbnail;  ///< the first picture or page, small, as .jpg; not of a .pdf; empty: none
  Provenance provenance;
};

/** From a scan or surface files to pictures. */
struct RenderScanSettings : PictureSettings
{
  RenderSettings render;            ///< its memory is the source's, its margins those of the annotations
  std::vector<View> views{ {} };    ///< of the surfaces
  std::string focus;                ///< pattern of the surfaces that the picture is fitted to; empty: all
  double ghost = 0.15;              ///< opacity of what hides the focus; 0: left out; 1: as it is
  std::vector<CutRequest> cuts;     ///< at most 6; cut faces have the scan's greys
  std::vector<std::string> uncut;   ///< patterns of surfaces that are not cut
  std::vector<PlaneRequest> planes; ///< slices that stand in the scene
  AnnotationSettings annotations;
  std::size_t turntable = 0;     ///< number of views around the patient, instead of the views; 0: none
  std::size_t onlyPicture = 0;   ///< the number, from 1, of the only view or slice to draw; 0: all
  std::filesystem::path picture; ///< with more than one, a view's or plane's name is added to the stem; a turntable is
                                 ///< one .gif, or numbered pictures
};

/** Checks the settings, without reading or writing anything. Returns the files that RenderScan() writes. Throws
 * Failure(Usage). */
std::vector<std::filesystem::path>
CheckRenderScan(const RenderScanSettings & settings);

/** Draws pictures, with a sidecar for each; returns all files. They appear together at the end, or none does.
 * Throws Failure; for outputs that can't be written or drawn, before the scan is read.
 *
 * \param volume the scan's volume, if the caller has read the scan already */
std::vector<MadeFile>
RenderScan(const RenderScanSettings & settings,
           const Events & events,
           std::optional<SourceVolume> volume = std::nullopt);

/** What RenderScan() would take, without doing it: see rhombicMemoryPlan.h. Throws Failure, Usage for surface files. */
std::string
PlanRenderScan(const RenderScanSettings & settings, const Events & events);

/** From a scan or surface files to a page. */
struct RenderSheetSettings : PictureSettings
{
  std::vector<View> views{ StandardViews()[0],
                           StandardViews()[2],
                           StandardViews()[1],
                           StandardViews()[3] }; ///< up to 4
  PictureStyle style = PictureStyle::Paper;      ///< Clinic makes a dark page
  std::string title;
  bool letters = true; ///< the anatomical directions at the edges of pictures
  bool scaleBar = true;
  bool names = false; ///< as AnnotationSettings::names
  bool isLandscape = false;
  double pixelsPerInch = 200.0; ///< 36 to 600
  std::filesystem::path page;   ///< .png or .jpg for one page; .tif or .pdf for all
};

/** Checks as CheckRenderScan() does. Returns the files of the first page. */
std::vector<std::filesystem::path>
CheckRenderSheet(const RenderSheetSettings & settings);

/** Draws a page, A4: views, slices with outlines, a table of the surfaces, and where they come
 * from. Long tables go on on further pages; a format of one page then has a file for each. Returns all files.
 * Throws as RenderScan() does.
 *
 * \param volume the scan's volume, if the caller has read the scan already */
std::vector<MadeFile>
RenderSheet(const RenderSheetSettings & settings,
            const Events & events,
            std::optional<SourceVolume> volume = std::nullopt);

/** As PlanRenderScan(). */
std::string
PlanRenderSheet(const RenderSheetSettings & settings, const Events & events);

} // namespace rhombic

#endif
