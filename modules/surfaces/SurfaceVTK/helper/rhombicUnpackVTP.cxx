// rhombic-unpack-vtp: makes binary PLY files of VTP files by VTK, which damaged files can crash: points, their normals,
// polygons, and the names and colours of surfaces that WriteSurfaces() stores.

#include "rhombicSandboxChild.h"
#include "rhombicWording.h"

#include <nlohmann/json.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rhombic
{
namespace
{

/** \class MessageCollector
 * \brief Keeps the first error or warning of VTK, which would be printed. */
class MessageCollector : public vtkOutputWindow
{
public:
  static MessageCollector *
  New();
  vtkTypeMacro(MessageCollector, vtkOutputWindow);

  void
  DisplayText(const char * text) override
  {
    m_First = m_First.empty() ? text : m_First;
  }

  /** The message on one line, without the source file and the address of the object; empty if there was none. */
  std::string
  GetFirst() const
  {
    const std::size_t object = m_First.find("): ");
    std::string message = m_First.substr(object == std::string::npos ? 0 : object + 3);
    std::replace_if(
      message.begin(), message.end(), [](unsigned char letter) { return letter < ' '; }, ' ');
    return message.substr(0, message.find_last_not_of(" .") + 1);
  }

private:
  std::string m_First;
};

vtkStandardNewMacro(MessageCollector);

constexpr std::string_view Blanks = " \t\r\n\v\f";

/** Whether a word of an array in text is a number of the array's type. True for types that VTK refuses. */
bool
IsNumberOfType(std::string_view word, std::string_view type)
{
  static const std::map<std::string_view, std::array<std::int64_t, 2>> limits{
    { "Int8", { INT8_MIN, INT8_MAX } },    { "UInt8", { 0, UINT8_MAX } },         { "Int16", { INT16_MIN, INT16_MAX } },
    { "UInt16", { 0, UINT16_MAX } },       { "Int32", { INT32_MIN, INT32_MAX } }, { "UInt32", { 0, UINT32_MAX } },
    { "Int64", { INT64_MIN, INT64_MAX } }, { "UInt64", { 0, INT64_MAX } },        { "String", { INT8_MIN, UINT8_MAX } }
  };
  word.remove_prefix(word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
  if (type == "Float32" || type == "Float64")
  {
    const auto number = ToNumber<double>(word);
    const double largest = type == "Float32" ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    return number && !(std::abs(*number) > largest); // VTK reads infinity as 0
  }
  const auto found = limits.find(type);
  const auto number = ToNumber<std::int64_t>(word);
  return found == limits.end() || (number && *number >= found->second[0] && *number <= found->second[1]) ||
         (type == "UInt64" && ToNumber<std::uint64_t>(word));
}

/** Takes the next attribute of an element, and the blanks around it, from \a text. Its name is empty behind the last,
 * and where the text makes no sense: VTK refuses this. */
std::pair<std::string_view, std::string_view>
TakeAttribute(std::string_view & text)
{
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n/"), text.size()));
  const std::size_t quote = text.find_first_of("\"'>");
  if (quote == std::string_view::npos || text[quote] == '>')
  {
    return {};
  }
  const std::string_view name = Trim(text.substr(0, std::min(text.find('='), quote)));
  const std::string_view value = text.substr(quote + 1, text.find(text[quote], quote + 1) - quote - 1);
  text.remove_prefix(std::min(quote + value.size() + 2, text.size()));
  return { name, value };
}

/** Throws SandboxRefusal for a word of an array in text that is no number of the array's type. */
void
RequireNumbersOfType(std::string_view text, std::string_view type)
{
  while ((text.remove_prefix(std::min(text.find_first_not_of(Blanks), text.size())), !text.empty()))
  {
    const std::string_view word = text.substr(0, text.find_first_of(Blanks));
    if (!IsNumberOfType(word, type))
    {
      throw SandboxRefusal("one of its numbers of the type " + std::string(type) +
                           " is none, or out of the type's range; the file is damaged, so export it again");
    }
    text.remove_prefix(word.size());
  }
}

/** Throws SandboxRefusal for a number of points, cells or components that is no whole number, and for numbers of arrays
 * in text that are none. VTK reads the digits at their beginning. */
void
RequireNumbers(std::string_view xml)
{
  const std::string_view elements = xml.substr(0, xml.find("<AppendedData"));
  for (std::size_t at = elements.find('<'); at < elements.size();)
  {
    const std::size_t inside = elements.substr(at, 4) == "<!--" ? elements.find("-->", at) : at + 1;
    const std::size_t next = std::min(elements.find('<', inside), elements.size());
    std::string_view text = elements.substr(at + 1, next - at - 1); // an element's start and the text behind it
    at = next;
    const std::string_view element = text.substr(0, text.find_first_of(" \t\r\n/>"));
    if (element.empty() || element[0] == '!' || element[0] == '?') // an end, a comment, a declaration
    {
      continue;
    }
    text.remove_prefix(element.size());
    std::map<std::string_view, std::string_view> attributes;
    for (auto attribute = TakeAttribute(text); !attribute.first.empty(); attribute = TakeAttribute(text))
    {
      const auto & [name, value] = *attributes.insert(attribute).first;
      if (name.rfind("NumberOf", 0) == 0 && (!ToNumber<std::int64_t>(value) || value[0] == '-'))
      {
        throw SandboxRefusal("its " + std::string(name) +
                             " is no whole number; the file is damaged, so export it again");
      }
    }
    const bool isArray = element == "DataArray" || element == "Array";
    if (isArray && attributes.count("offset") == 0 && attributes["format"] != "binary" && !text.empty())
    {
      RequireNumbersOfType(text.substr(1), attributes["type"]);
    }
  }
}

/** Reads the file. Any message of VTK is a failure, as VTK goes on after errors. */
vtkSmartPointer<vtkPolyData>
ReadPolyData(const SandboxInput & input)
{
  vtkNew<MessageCollector> messages;
  vtkOutputWindow::SetInstance(messages);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  const std::string xml(reinterpret_cast<const char *>(input.file), input.size);
  RequireNumbers(xml);
  reader->SetInputString(xml);
  reader->Update();
  const vtkSmartPointer<vtkPolyData> polyData = reader->GetOutput();
  std::string why = messages->GetFirst();
  if (why.empty() && (reader->GetErrorCode() != 0 || !polyData->GetPolys()->IsValid()))
  {
    why = "its polygons are damaged";
  }
  if (!why.empty())
  {
    throw SandboxRefusal(why + "; the file is damaged, so export it again");
  }
  return polyData;
}

/** An array of the fields with \a components numbers for each of \a count surfaces, or null. */
vtkDataArray *
FindField(vtkPolyData & polyData, const char * name, int components, vtkIdType count)
{
  vtkDataArray * const array = polyData.GetFieldData()->GetArray(name);
  const bool fits =
    array != nullptr && array->GetNumberOfComponents() == components && array->GetNumberOfTuples() == count;
  return fits ? array : nullptr;
}

/** Names, colours and opacities of surfaces, from the fields that WriteVTP() writes. */
class SurfaceFields
{
public:
  explicit SurfaceFields(vtkPolyData & polyData)
    : m_Names(vtkStringArray::SafeDownCast(polyData.GetFieldData()->GetAbstractArray("SurfaceNames")))
    , m_Count(m_Names == nullptr ? 0 : m_Names->GetNumberOfValues())
    , m_Colours(FindField(polyData, "SurfaceColours", 3, m_Count))
    , m_Opacities(FindField(polyData, "SurfaceOpacities", 1, m_Count))
  {}

  /** The number of surfaces; 0 if the fields are not there. */
  vtkIdType
  GetCount() const
  {
    return m_Colours != nullptr && m_Opacities != nullptr ? m_Count : 0;
  }

  /** A comment of a PLY file, as WritePLY() makes it. */
  std::string
  Describe(vtkIdType surface, double points, double triangles) const
  {
    return DescribeSurface(
      m_Names->GetValue(surface),
      { m_Colours->GetComponent(surface, 0), m_Colours->GetComponent(surface, 1), m_Colours->GetComponent(surface, 2) },
      m_Opacities->GetComponent(surface, 0),
      points,
      triangles);
  }

  static std::string
  DescribeSurface(const std::string & name,
                  const std::array<double, 3> & colour,
                  double opacity,
                  double points,
                  double triangles)
  {
    const nlohmann::json description{
      { "name", name }, { "colour", colour }, { "opacity", opacity }, { "points", points }, { "triangles", triangles }
    };
    return "comment SURFACE " + description.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
  }

private:
  vtkStringArray * m_Names;
  vtkIdType m_Count;
  vtkDataArray * m_Colours;
  vtkDataArray * m_Opacities;
};

/** "comment SPACE=RAS" if the file says so. */
std::string
DescribeSpace(vtkPolyData & polyData)
{
  auto * const space = vtkStringArray::SafeDownCast(polyData.GetFieldData()->GetAbstractArray("SPACE"));
  const bool isRAS = space != nullptr && space->GetNumberOfValues() > 0 && space->GetValue(0) == "RAS";
  return isRAS ? "comment SPACE=RAS\n" : "";
}

/** Descriptions of the surfaces, which follow each other in the file. */
std::string
DescribeSurfaces(vtkPolyData & polyData)
{
  const SurfaceFields fields(polyData);
  vtkDataArray * const sizes = FindField(polyData, "SurfaceSizes", 2, fields.GetCount());
  std::string comments;
  for (vtkIdType n = 0; sizes != nullptr && n < fields.GetCount(); ++n)
  {
    comments += fields.Describe(n, sizes->GetComponent(n, 0), sizes->GetComponent(n, 1));
  }
  return comments;
}

/** \class LimitedBytes
 * \brief Appends to memory of a fixed size. */
class LimitedBytes
{
public:
  LimitedBytes(std::byte * bytes, std::size_t size)
    : m_Next(bytes)
    , m_Left(size)
  {}

  std::size_t
  GetLeft() const
  {
    return m_Left;
  }

  void
  Append(const void * from, std::size_t size)
  {
    if (size > m_Left)
    {
      throw SandboxRefusal("it unpacks to many times its size; export it uncompressed");
    }
    std::copy_n(static_cast<const std::byte *>(from), size, m_Next);
    m_Next += size;
    m_Left -= size;
  }

private:
  std::byte * m_Next;
  std::size_t m_Left;
};

std::array<float, 3>
GetFloats(vtkDataArray & vectors, vtkIdType n)
{
  std::array<double, 3> vector{};
  vectors.GetTuple(n, vector.data());
  return { static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2]) };
}

void
AppendPoints(vtkPolyData & polyData, vtkDataArray * normals, LimitedBytes & ply)
{
  for (vtkIdType n = 0; n < polyData.GetNumberOfPoints(); ++n)
  {
    for (vtkDataArray * const vectors : { polyData.GetPoints()->GetData(), normals })
    {
      if (vectors != nullptr)
      {
        const auto floats = GetFloats(*vectors, n);
        ply.Append(floats.data(), sizeof(floats));
      }
    }
  }
}

/** The number of corners, then their points. */
using Polygon = std::vector<std::uint32_t>;

void
GetPolygon(vtkCellArray & polygons, vtkIdType n, vtkIdList * corners, Polygon & polygon)
{
  polygons.GetCellAtId(n, corners);
  polygon.assign(1, static_cast<std::uint32_t>(corners->GetNumberOfIds()));
  std::transform(corners->begin(), corners->end(), std::back_inserter(polygon), [](vtkIdType corner) {
    return corner >= 0 && corner < UINT32_MAX ? static_cast<std::uint32_t>(corner) : UINT32_MAX;
  });
}

void
AppendPolygons(vtkCellArray & polygons, LimitedBytes & ply)
{
  vtkNew<vtkIdList> corners;
  Polygon polygon;
  for (vtkIdType n = 0; n < polygons.GetNumberOfCells(); ++n)
  {
    GetPolygon(polygons, n, corners, polygon);
    ply.Append(polygon.data(), polygon.size() * sizeof(std::uint32_t));
  }
}

std::string
MakeHeader(const std::string & comments, std::size_t points, bool haveNormals, std::size_t polygons)
{
  return "ply\nformat binary_little_endian 1.0\n" + comments + "element vertex " + std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\n" +
         (haveNormals ? "property float nx\nproperty float ny\nproperty float nz\n" : "") + "element face " +
         std::to_string(polygons) + "\nproperty list uint uint vertex_indices\nend_header\n";
}

/** The two labels of each polygon, as vtkSurfaceNets3D makes them, after those of points and lines; or null. */
vtkDataArray *
FindBoundaryLabels(vtkPolyData & polyData)
{
  vtkDataArray * const labels = polyData.GetCellData()->GetArray("BoundaryLabels");
  const bool fits = labels != nullptr && labels->GetNumberOfComponents() == 2 &&
                    labels->GetNumberOfTuples() == polyData.GetNumberOfCells();
  return fits ? labels : nullptr;
}

/** The closed surface of each label but 0, which is outside, as parts of one PLY file. Walls are counter-clockwise seen
 * from outside of their first label, and in the surface of the second turned over. */
void
AppendLabels(vtkPolyData & polyData, vtkDataArray & boundaryLabels, LimitedBytes & ply)
{
  const vtkIdType first = polyData.GetNumberOfVerts() + polyData.GetNumberOfLines();
  std::map<double, std::vector<std::pair<vtkIdType, bool>>> walls; // of each label; whether they are turned over
  for (vtkIdType n = 0; n < polyData.GetNumberOfPolys(); ++n)
  {
    for (const int side : { 0, 1 })
    {
      const double label = boundaryLabels.GetComponent(first + n, side);
      if (label != 0.0 && !std::isnan(label))
      {
        walls[label].emplace_back(n, side == 1);
      }
    }
  }
  const SurfaceFields fields(polyData);
  vtkDataArray * const values = FindField(polyData, "SurfaceLabels", 1, fields.GetCount());
  std::string comments = DescribeSpace(polyData);
  std::vector<vtkIdType> points;
  std::vector<Polygon> polygons;
  std::vector<std::uint32_t> numbers(static_cast<std::size_t>(polyData.GetNumberOfPoints()));
  vtkNew<vtkIdList> corners;
  Polygon polygon;
  for (const auto & [label, parts] : walls)
  {
    const std::size_t firstPoint = points.size();
    for (const auto & [wall, isTurned] : parts)
    {
      GetPolygon(*polyData.GetPolys(), wall, corners, polygon);
      for (auto corner = polygon.begin() + 1; corner != polygon.end(); ++corner)
      {
        if (*corner >= numbers.size())
        {
          *corner = UINT32_MAX; // refused by the reader of PLY
          continue;
        }
        std::uint32_t & number = numbers[*corner];
        if (number < firstPoint || number >= points.size() || points[number] != static_cast<vtkIdType>(*corner))
        {
          number = static_cast<std::uint32_t>(points.size());
          points.push_back(*corner);
        }
        *corner = number;
      }
      if (isTurned)
      {
        std::reverse(polygon.begin() + 1, polygon.end());
      }
      polygons.push_back(polygon);
    }
    vtkIdType surface = 0;
    while (values != nullptr && surface < fields.GetCount() && values->GetComponent(surface, 0) != label)
    {
      ++surface;
    }
    const auto pointCount = static_cast<double>(points.size() - firstPoint);
    const auto triangles = static_cast<double>(parts.size());
    const std::string name = "label " + std::to_string(std::lround(label));
    comments += values != nullptr && surface < fields.GetCount()
                  ? fields.Describe(surface, pointCount, triangles)
                  : SurfaceFields::DescribeSurface(name, { 204.0, 204.0, 204.0 }, 1.0, pointCount, triangles);
  }
  const std::string header = MakeHeader(comments, points.size(), false, polygons.size());
  ply.Append(header.data(), header.size());
  for (const vtkIdType point : points)
  {
    const auto floats = GetFloats(*polyData.GetPoints()->GetData(), point);
    ply.Append(floats.data(), sizeof(floats));
  }
  for (const Polygon & numbered : polygons)
  {
    ply.Append(numbered.data(), numbered.size() * sizeof(std::uint32_t));
  }
}

void
AppendSurfaces(vtkPolyData & polyData, LimitedBytes & ply)
{
  vtkDataArray * normals = polyData.GetPointData()->GetNormals();
  if (normals != nullptr &&
      (normals->GetNumberOfComponents() != 3 || normals->GetNumberOfTuples() != polyData.GetNumberOfPoints()))
  {
    normals = nullptr;
  }
  const std::string header = MakeHeader(DescribeSpace(polyData) + DescribeSurfaces(polyData),
                                        static_cast<std::size_t>(polyData.GetNumberOfPoints()),
                                        normals != nullptr,
                                        static_cast<std::size_t>(polyData.GetNumberOfPolys()));
  ply.Append(header.data(), header.size());
  AppendPoints(polyData, normals, ply);
  AppendPolygons(*polyData.GetPolys(), ply);
}

/** Makes the PLY file as one piece. */
void
UnpackVTP(const SandboxInput & input, SandboxOutput & output)
{
  const vtkSmartPointer<vtkPolyData> polyData = ReadPolyData(input);
  LimitedBytes ply(output.GetBuffer(), output.GetSize());
  if (vtkDataArray * const labels = FindBoundaryLabels(*polyData))
  {
    AppendLabels(*polyData, *labels, ply);
  }
  else
  {
    AppendSurfaces(*polyData, ply);
  }
  output.Deliver(output.GetSize() - ply.GetLeft());
}

} // namespace
} // namespace rhombic

int
main(int argc, char ** argv)
{
  return rhombic::RunSandboxChild(argc, argv, rhombic::UnpackVTP);
}
