#ifndef rhombicInteractivePage_h
#define rhombicInteractivePage_h

#include "rhombicColourScale.h"
#include "rhombicEvents.h"
#include "rhombicGreyWindow.h"
#include "rhombicPicture.h"
#include "rhombicProjection.h"
#include "rhombicScan.h"
#include "rhombicSceneSurface.h"
#include "rhombicSlicePlane.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** A still picture of a page. */
struct StillPicture
{
  Picture picture;
  std::string caption; ///< "anterior", "axial, z = -123.4 mm"
};

/** A surface of a page, with what its row tells. */
struct PageSurface
{
  SceneSurface scene;
  std::string group;            ///< surfaces of one group are listed together; empty: none
  std::optional<double> volume; ///< ml
  std::optional<double> area;   ///< cm2
  std::optional<double> mean;   ///< of the scan inside the surface
  bool isHidden = false;        ///< until a user shows the surface
};

/** A table of other numbers than volumes, areas and mean values. */
struct PageTable
{
  /** A line of the table. */
  struct Row
  {
    std::string name;
    Colour colour{};
    std::vector<std::string> cells; ///< one for each heading
  };

  std::vector<std::string> headings;
  std::vector<Row> rows;
};

/** \class PageContent
 * \brief What an interactive page shows. Nothing else of the scan or of the machine gets into the page. */
struct PageContent
{
  std::string title;
  std::vector<std::string> facts; ///< lines about scan and method; a colon ends the name of a value
  std::vector<PageSurface> surfaces;
  std::optional<PageTable> table; ///< in place of that of the surfaces
  std::optional<Scan> scan;       ///< for slices
  SliceBox box;                   ///< of the scan
  GreyWindow window;              ///< in which slices are shown first
  std::string unit;               ///< of the scan's values: "HU"; empty if unknown
  bool isOriented = true;         ///< whether sides of the patient are known; without, there are no letters
  std::vector<StillPicture> views;
  std::vector<StillPicture> slices;
  std::vector<std::string> turntable;     ///< JPEG files of views: from the front towards the patient's left
  std::uintmax_t largestSize = 8'000'000; ///< bytes of the page that simplification aims at

  /** Of SceneSurface::pointValues, which give the colours of the surfaces that have them; with a bar. */
  std::optional<ColourScale> scale;
};

/** What a page holds, and what was left out to keep it small. */
struct PageWeight
{
  std::uintmax_t size = 0;           ///< bytes of the page
  std::uintmax_t sizeOfSurfaces = 0; ///< bytes of these parts in the page
  std::uintmax_t sizeOfSlices = 0;
  std::uintmax_t sizeOfPictures = 0;
  std::size_t trianglesBefore = 0; ///< of the surfaces that were given; those of shared walls count for each
  std::size_t triangles = 0;
  double measuredError = 0.0; ///< mm: the largest distance of simplified surfaces where it was measured
  double quantum = 0.0;       ///< mm: the distance of positions that the page can tell apart
  std::array<int, 3> grid{};  ///< samples of the slices along x, y and z; 0 without slices
  Vector3 spacing{};          ///< mm
  double valueError = 0.0;    ///< the largest error of values from -200 to 300 HU, or of all values of other scans
  double lowest = 0.0;        ///< values below and above are not told apart
  double highest = 0.0;
  std::vector<std::string> notes; ///< sentences about what was reduced
};

/** A page, and what it holds. */
struct MadePage
{
  std::string html;
  PageWeight weight;
};

/** Makes a page: one HTML file that shows pictures and a table without scripts, slices and a turntable with scripts,
 * and surfaces that can be turned with WebGL2. Its Content-Security-Policy forbids every request to a network.
 *
 * Surfaces are simplified by quadrics (InFewerTriangles()) as far as 0.1 mm allows, or up to 3.2 mm to as many
 * triangles as there is room for in PageContent::largestSize; slices are resampled to at most 256 x 256 x 256 samples
 * along the patient's axes, in fewer grey levels where surfaces would have too little room. Values of points have 255
 * steps from the scale's lower to its upper end; surfaces with values do not share walls, so that each has its own
 * values there. A page that is too large all the same is made, with a note. The same bytes for any number of threads.
 * Pictures and surfaces are freed as soon as they are coded or joined, where nobody else holds them: give the content
 * away by std::move().
 *
 * Throws Failure(Usage) without surfaces. */
MadePage
MakeInteractivePage(PageContent content, const Events & events);

} // namespace rhombic

#endif
