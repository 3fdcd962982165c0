#include "rhombicInteractivePage.h"

#include "itkTriangleSurfaceDistance.h"
#include "rhombicFailure.h"
#include "rhombicFewerTriangles.h"
#include "rhombicMemoryBudget.h"
#include "rhombicPageBytes.h"
#include "rhombicPageMesh.h"
#include "rhombicPageResources.h"
#include "rhombicPageVolume.h"
#include "rhombicPictureIO.h"
#include "rhombicWording.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace rhombic
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr int SlicesOfBlock = 16;

/** How slices are coded, where surfaces then have room for a share of their bytes: the first row that they have. */
struct SliceCoding
{
  int levelFactor;   ///< grey levels so many times as far from each other
  int sliceStep;     ///< every so many slices
  double leastShare; ///< of the bytes of surfaces that are simplified by SmallestError only
};

constexpr SliceCoding SliceCodings[] = { { 1, 1, 1.0 }, { 2, 1, 0.4 }, { 4, 1, 0.2 }, { 4, 2, 0.08 }, { 4, 4, 0.0 } };

constexpr double ShareOfPictures = 0.7; // of the page's size, at most; else there are fewer views around the patient
constexpr std::size_t FewestTurns = 6;
constexpr double SmallestError = 0.1;        // mm, of simplification: less is not seen
constexpr double LargestError = 3.2;         // mm
constexpr std::uintmax_t SizeOfNotes = 2000; // bytes, at most, what the page says of its reduction

/** A data block of the page: what browsers do not run, under an id that the script looks for. */
std::string
DataBlock(const std::string & id, std::string_view bytes)
{
  return "<script type=\"application/octet-stream\" id=\"" + id + "\">" + ToBase64(bytes) + "</script>\n";
}

std::string
HexOf(const Colour & colour)
{
  constexpr char digits[] = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t byte : ToBytes(colour))
  {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

/** A picture with its caption. */
std::string
FigureOf(const StillPicture & picture, const std::string & what)
{
  constexpr int quality = 85;
  const std::string caption = EscapeHtml(picture.caption);
  return "<figure><img alt=\"" + what + ": " + caption + "\" width=\"" + std::to_string(picture.picture.width) +
         "\" height=\"" + std::to_string(picture.picture.height) + "\" src=\"data:image/jpeg;base64," +
         ToBase64(EncodeJpeg(picture.picture, quality, false)) + "\"><figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::string
FiguresOf(const std::vector<StillPicture> & pictures, const std::string & what)
{
  std::string figures;
  for (const StillPicture & picture : pictures)
  {
    figures += FigureOf(picture, what);
  }
  return figures.empty() ? "" : "<div class=\"figures\">\n" + figures + "</div>\n";
}

/** The table of the surfaces' volumes, areas and mean values. */
PageTable
MeasuresOf(const PageContent & content)
{
  const auto cell = [](const std::optional<double> & number) { return number ? FormatFixed(*number, 1) : ""; };
  PageTable table{
    { "volume, ml", "surface, cm\xc2\xb2", "mean value" + (content.unit.empty() ? "" : ", " + content.unit) }, {}
  };
  for (const PageSurface & surface : content.surfaces)
  {
    table.rows.push_back(
      { surface.scene.name, surface.scene.colour, { cell(surface.volume), cell(surface.area), cell(surface.mean) } });
  }
  return table;
}

std::string
WriteTable(const PageTable & table)
{
  std::string text = "<div class=\"wide\"><table>\n<thead><tr><th></th><th scope=\"col\">structure</th>";
  for (const std::string & heading : table.headings)
  {
    text += "<th scope=\"col\" class=\"number\">" + EscapeHtml(heading) + "</th>";
  }
  text += "</tr></thead>\n<tbody>\n";
  for (const PageTable::Row & row : table.rows)
  {
    text += "<tr><td><svg class=\"swatch\" viewBox=\"0 0 10 10\" aria-hidden=\"true\"><rect width=\"10\" height=\"10\" "
            "rx=\"2\" fill=\"" +
            HexOf(row.colour) + "\"/></svg></td><th scope=\"row\"><bdi>" + EscapeHtml(row.name) + "</bdi></th>";
    for (const std::string & cell : row.cells)
    {
      text += "<td class=\"number\">" + EscapeHtml(cell) + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table></div>\n";
}

std::string
ListOf(const std::vector<std::string> & lines)
{
  std::string list;
  for (const std::string & line : lines)
  {
    list += "<li>" + EscapeHtml(line) + "</li>\n";
  }
  return list;
}

Json
DescribeSurfaces(const PageContent & content)
{
  Json surfaces = Json::array();
  for (const PageSurface & surface : content.surfaces)
  {
    Json entry{ { "name", surface.scene.name },
                { "colour", ToBytes(surface.scene.colour) },
                { "opacity", surface.scene.opacity },
                { "glossy", surface.scene.isGlossy },
                { "smooth", surface.scene.surface->HasNormals() } };
    if (surface.scene.layer > 0)
    {
      entry["layer"] = surface.scene.layer;
      entry["gap"] = std::max(surface.scene.layerGap, 2.0 * SmallestError); // walls are simplified by so much
    }
    if (!surface.group.empty())
    {
      entry["group"] = surface.group;
    }
    if (surface.isHidden)
    {
      entry["hidden"] = true;
    }
    if (surface.volume)
    {
      entry["volume"] = *surface.volume;
    }
    surfaces.push_back(entry);
  }
  return surfaces;
}

Json
DescribeMesh(const PageMesh & mesh)
{
  Json sheets = Json::array();
  for (const PageSheet & sheet : mesh.sheets)
  {
    sheets.push_back({ sheet.front, sheet.back, sheet.triangles });
  }
  return { { "origin", mesh.origin }, { "extent", mesh.extent },       { "quantum", mesh.quantum },
           { "points", mesh.points }, { "triangles", mesh.triangles }, { "sheets", sheets } };
}

Json
DescribeVolume(const PageVolume & volume, const PageContent & content, std::size_t blocks)
{
  Json windows = Json::array();
  if (content.unit == "HU")
  {
    for (const auto & [name, window] : WindowPresets())
    {
      windows.push_back({ name, window.width, window.centre });
    }
  }
  return { { "size", volume.size },       { "origin", volume.origin },
           { "spacing", volume.spacing }, { "levels", volume.levels },
           { "blocks", blocks },          { "slicesOfBlock", SlicesOfBlock },
           { "unit", content.unit },      { "window", { content.window.width, content.window.centre } },
           { "windows", windows },        { "resampled", volume.isResampled } };
}

/** What the script has to know of the colours of numbers: 255 of them, from the scale's lower end to its upper end, and
 * the shares of the bar below its marks. */
Json
DescribeColours(const ColourScale & scale)
{
  constexpr int steps = 254;
  std::string map;
  for (int n = 0; n <= steps; ++n)
  {
    map += HexOf(ColourOf(scale, scale.low + (scale.high - scale.low) * n / steps)).substr(1);
  }
  Json marks = Json::array();
  for (const double mark : scale.marks)
  {
    const double share = (mark - scale.low) / (scale.high - scale.low);
    if (share > 0.0 && share < 1.0)
    {
      marks.push_back(share);
    }
  }
  return { { "title", scale.title }, { "numbers", NumbersOnBar(scale) }, { "map", map }, { "marks", marks } };
}

/** Everything of a page that does not depend on its reduction. */
struct FixedParts
{
  std::string pictures; ///< HTML
  std::string table;
  std::string turntable;       ///< data blocks
  std::size_t turns = 0;       ///< number of them
  std::size_t turnsBefore = 0; ///< number of those that were drawn
  Json surfaces;               ///< what the script has to know of them
};

/** Parts of a page that are made as small as it needs. */
struct ReducedParts
{
  PageMesh mesh;
  std::size_t triangles = 0;  ///< of the surfaces; those of shared walls count for each
  double measuredError = 0.0; ///< mm, the largest distance of simplified surfaces where it was measured
  PageVolume volume;
  std::string surfaceBlocks;
  std::string sliceBlocks;
  std::size_t numberOfSliceBlocks = 0;
};

bool
HasSlices(const PageVolume & volume)
{
  return volume.size[0] > 0;
}

/** Takes the pictures of the content, which are not needed after that. */
FixedParts
MakeFixedParts(PageContent & content)
{
  FixedParts parts;
  parts.pictures = FiguresOf(content.views, "view") + FiguresOf(content.slices, "slice");
  parts.table = WriteTable(content.table ? *content.table : MeasuresOf(content));
  parts.surfaces = DescribeSurfaces(content);
  std::vector<std::string> & turns = content.turntable;
  const auto sizeOf = [](const std::vector<std::string> & pictures) {
    return std::accumulate(pictures.begin(), pictures.end(), 0.0, [](double sum, const std::string & picture) {
      return sum + 4.0 / 3.0 * static_cast<double>(picture.size()); // in base64
    });
  };
  const double room =
    ShareOfPictures * static_cast<double>(content.largestSize) - static_cast<double>(parts.pictures.size());
  parts.turnsBefore = turns.size();
  while (sizeOf(turns) > room && turns.size() % 2 == 0 && turns.size() / 2 >= FewestTurns)
  {
    for (std::size_t n = 0; 2 * n < turns.size(); ++n)
    {
      turns[n].swap(turns[2 * n]);
    }
    turns.resize(turns.size() / 2);
  }
  parts.turns = turns.size();
  for (std::size_t n = 0; n < turns.size(); ++n)
  {
    parts.turntable += DataBlock("turn-" + std::to_string(n), turns[n]);
  }
  turns = {};
  content.views = content.slices = {};
  return parts;
}

/** Takes the surfaces of the content. */
std::vector<SceneSurface>
TakeSurfaces(PageContent & content)
{
  std::vector<SceneSurface> surfaces;
  for (PageSurface & surface : content.surfaces)
  {
    surfaces.push_back(std::move(surface.scene));
  }
  content.surfaces.clear();
  return surfaces;
}

std::size_t
CountTriangles(const std::vector<SceneSurface> & surfaces)
{
  return std::accumulate(
    surfaces.begin(), surfaces.end(), std::size_t{ 0 }, [](std::size_t sum, const SceneSurface & surface) {
      return sum + surface.surface->GetNumberOfTriangles();
    });
}

/** The largest distance in mm between surfaces and the same ones in fewer triangles, measured at some of each. */
double
MeasureError(const std::vector<SceneSurface> & surfaces, const std::vector<SceneSurface> & fewer)
{
  constexpr double measured = 60'000.0; // triangles, about
  const double share = std::min(1.0, measured / static_cast<double>(CountTriangles(surfaces)));
  double largest = 0.0;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const itk::TriangleSurface & surface = *surfaces[n].surface;
    if (surface.GetNumberOfTriangles() > 0)
    {
      const auto some = static_cast<itk::SizeValueType>(share * static_cast<double>(surface.GetNumberOfTriangles()));
      const auto distances =
        ComputeTriangleSurfaceDistances(surface, *fewer[n].surface, std::max<itk::SizeValueType>(1, some));
      largest = std::max(largest, distances.GetMaximum());
    }
  }
  return largest;
}

/** Codes surfaces in fewer triangles. */
void
CodeSurfaces(const std::vector<SceneSurface> & surfaces, const std::optional<ColourScale> & scale, ReducedParts & parts)
{
  parts.mesh = MakePageMesh(surfaces, scale);
  parts.triangles = CountTriangles(surfaces);
  parts.surfaceBlocks = DataBlock("points", parts.mesh.pointBytes) + DataBlock("triangles", parts.mesh.triangleBytes);
}

/** Simplifies surfaces by an error that is not seen, and goes on with larger errors only where that is too little for
 * the room that \a findRoom finds once they are coded. */
void
ReduceSurfaces(const std::vector<SceneSurface> & surfaces,
               const std::optional<ColourScale> & scale,
               const std::function<std::uintmax_t()> & findRoom,
               const Events & events,
               ReducedParts & parts)
{
  std::optional<double> room;
  double leastShare = 0.0;
  double errorBefore = 0.0;
  std::vector<SceneSurface> fewer = surfaces;
  for (double error = SmallestError; error <= LargestError; error *= 2.0)
  {
    events.Progress("simplifying surfaces", 0.0);
    fewer = InFewerTriangles(fewer, error - std::exchange(errorBefore, error), leastShare);
    GiveBackFreedMemory();
    events.Progress("coding surfaces", 0.0);
    CodeSurfaces(fewer, scale, parts);
    if (!room)
    {
      room = static_cast<double>(findRoom());
    }
    const auto taken = static_cast<double>(parts.surfaceBlocks.size());
    if (taken <= *room)
    {
      break;
    }
    constexpr double safety = 0.98; // fewer triangles need more bytes each
    leastShare = safety * *room / taken;
  }
  parts.measuredError = MeasureError(surfaces, fewer);
}

void
CodeSlices(PageVolume volume, ReducedParts & parts)
{
  parts.volume = std::move(volume);
  parts.sliceBlocks.clear();
  const std::vector<std::string> blocks = EncodeVolume(parts.volume, SlicesOfBlock);
  parts.numberOfSliceBlocks = blocks.size();
  for (std::size_t n = 0; n < blocks.size(); ++n)
  {
    parts.sliceBlocks += DataBlock("slices-" + std::to_string(n), blocks[n]);
  }
  parts.volume.numbers = {};
}

std::vector<std::string>
DescribeReduction(const PageWeight & weight,
                  const PageContent & content,
                  const FixedParts & fixed,
                  const ReducedParts & parts)
{
  const std::string unit = content.unit.empty() ? "" : " " + content.unit;
  std::vector<std::string> notes;
  const std::string steps = "; positions in steps of " + FormatNumber(weight.quantum, 2) + " mm";
  notes.push_back("surfaces: " + std::to_string(weight.triangles) +
                  (weight.triangles == weight.trianglesBefore
                     ? " triangles, not simplified"
                     : " of " + std::to_string(weight.trianglesBefore) + " triangles, " +
                         FormatNumber(weight.measuredError, 2) + " mm away at most where measured") +
                  steps);
  if (HasSlices(parts.volume))
  {
    notes.push_back("slices: " + FormatProduct(weight.grid) + " samples of " + FormatProduct(weight.spacing, 3) +
                    " mm" + (parts.volume.isResampled ? ", resampled from slices that lie otherwise" : "") +
                    "; values rounded by at most " + FormatNumber(weight.valueError, 3) + unit +
                    (content.unit == "HU" ? " from -200 to 300 HU, by more elsewhere" : "") + ", those below " +
                    FormatNumber(weight.lowest, 5) + " and above " + FormatNumber(weight.highest, 5) + unit +
                    " are not told apart");
  }
  if (fixed.turns < fixed.turnsBefore)
  {
    notes.push_back("turntable: " + std::to_string(fixed.turns) + " of " + std::to_string(fixed.turnsBefore) +
                    " pictures");
  }
  if (weight.size > content.largestSize)
  {
    notes.push_back("size: " + FormatNumber(static_cast<double>(weight.size) / 1e6, 3) + " MB, more than the " +
                    FormatNumber(static_cast<double>(content.largestSize) / 1e6, 3) + " MB that were asked for");
  }
  return notes;
}

PageWeight
WeightOf(const FixedParts & fixed, const ReducedParts & parts)
{
  PageWeight weight;
  weight.sizeOfSurfaces = parts.surfaceBlocks.size();
  weight.sizeOfSlices = parts.sliceBlocks.size();
  weight.sizeOfPictures = fixed.pictures.size() + fixed.turntable.size();
  weight.triangles = parts.triangles;
  weight.measuredError = parts.measuredError;
  weight.quantum = parts.mesh.quantum;
  if (HasSlices(parts.volume))
  {
    weight.grid = parts.volume.size;
    weight.spacing = parts.volume.spacing;
    weight.valueError = parts.volume.largestError;
    weight.lowest = parts.volume.levels.front();
    weight.highest = parts.volume.levels.back();
  }
  return weight;
}

/** The template with the values of its places, which are written {{name}}. */
std::string
Fill(std::string_view text, const std::map<std::string, std::string> & values)
{
  std::string filled;
  while (true)
  {
    const auto begin = text.find("{{");
    filled += text.substr(0, begin);
    if (begin == std::string_view::npos)
    {
      return filled;
    }
    const auto end = text.find("}}", begin);
    filled += values.at(std::string(text.substr(begin + 2, end - begin - 2)));
    text.remove_prefix(end + 2);
  }
}

std::string
FillPage(const PageContent & content,
         const FixedParts & fixed,
         const ReducedParts & parts,
         const std::vector<std::string> & notes)
{
  Json data{ { "title", content.title },
             { "oriented", content.isOriented },
             { "surfaces", fixed.surfaces },
             { "mesh", DescribeMesh(parts.mesh) },
             { "turntable", fixed.turns } };
  if (content.scale)
  {
    data["colours"] = DescribeColours(*content.scale);
  }
  if (HasSlices(parts.volume))
  {
    data["volume"] = DescribeVolume(parts.volume, content, parts.numberOfSliceBlocks);
  }
  std::vector<std::string> facts = content.facts;
  facts.insert(facts.end(), notes.begin(), notes.end());
  return Fill(PageTemplate,
              { { "title", EscapeHtml(content.title) },
                { "styleHash", HashToBase64(PageStyleHash) },
                { "scriptHash", HashToBase64(PageScriptHash) },
                { "style", PageStyle },
                { "pictures", fixed.pictures },
                { "table", fixed.table },
                { "facts", ListOf(facts) },
                { "data", EscapeJsonInHtml(data.dump(-1, ' ', false, Json::error_handler_t::replace)) },
                { "blocks", parts.surfaceBlocks + parts.sliceBlocks + fixed.turntable },
                { "script", PageScript } });
}

/** Codes slices so that surfaces have enough room. Returns the bytes that they have. */
std::uintmax_t
CodeForRoom(const PageContent & content,
            const FixedParts & fixed,
            const PageVolume & volume,
            const Events & events,
            ReducedParts & parts)
{
  std::uintmax_t room = 0;
  for (const SliceCoding & coding : SliceCodings)
  {
    if (HasSlices(volume))
    {
      events.Progress("coding slices", 0.0);
      CodeSlices(Coarsen(volume, coding.levelFactor, coding.sliceStep), parts);
    }
    const std::uintmax_t others = FillPage(content, fixed, parts, {}).size() - parts.surfaceBlocks.size() + SizeOfNotes;
    room = content.largestSize > others ? content.largestSize - others : 0;
    if (static_cast<double>(room) >= coding.leastShare * static_cast<double>(parts.surfaceBlocks.size()))
    {
      break;
    }
  }
  return room;
}

} // namespace

MadePage
MakeInteractivePage(PageContent content, const Events & events)
{
  if (content.surfaces.empty())
  {
    throw Failure(FailureKind::Usage, "A page needs a surface, and there is none.");
  }
  events.Progress("coding pictures", 0.0);
  const FixedParts fixed = MakeFixedParts(content);
  events.Progress("sampling slices", 0.0);
  PageVolume volume = content.scan ? MakePageVolume(*content.scan, content.box) : PageVolume();
  content.scan.reset(); // its memory is needed for the surfaces
  const std::vector<SceneSurface> surfaces = TakeSurfaces(content);
  ReducedParts parts;
  ReduceSurfaces(
    surfaces, content.scale, [&]() { return CodeForRoom(content, fixed, volume, events, parts); }, events, parts);
  MadePage page;
  page.weight = WeightOf(fixed, parts);
  page.weight.trianglesBefore = CountTriangles(surfaces);
  page.weight.size = FillPage(content, fixed, parts, {}).size();
  page.weight.notes = DescribeReduction(page.weight, content, fixed, parts);
  page.html = FillPage(content, fixed, parts, page.weight.notes);
  page.weight.size = page.html.size();
  return page;
}

} // namespace rhombic
