#include "rhombicVTPToPLY.h"

#include "rhombicFailure.h"

#include <nlohmann/json.hpp>

#include <vtkCellArray.h>
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
#include <cstdint>
#include <vector>

namespace rhombic
{
namespace
{

namespace fs = std::filesystem;

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

/** Reads the file. Any message of VTK is a failure, as VTK goes on after errors. */
vtkSmartPointer<vtkPolyData>
ReadPolyData(const fs::path & path)
{
  vtkNew<MessageCollector> messages;
  const vtkSmartPointer<vtkOutputWindow> before = vtkOutputWindow::GetInstance();
  vtkOutputWindow::SetInstance(messages);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkOutputWindow::SetInstance(before);
  const vtkSmartPointer<vtkPolyData> polyData = reader->GetOutput();
  std::string why = messages->GetFirst();
  if (why.empty() && (reader->GetErrorCode() != 0 || !polyData->GetPolys()->IsValid()))
  {
    why = "its polygons are damaged";
  }
  if (!why.empty())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": " + why + "; the file is damaged, so export it again.");
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

/** Comments of a PLY file, as WritePLY() makes them, from the fields that WriteVTP() writes. */
std::string
DescribeSurfaces(vtkPolyData & polyData)
{
  const auto findStrings = [&polyData](const char * name) {
    return vtkStringArray::SafeDownCast(polyData.GetFieldData()->GetAbstractArray(name));
  };
  vtkStringArray * const space = findStrings("SPACE");
  const bool isRAS = space != nullptr && space->GetNumberOfValues() > 0 && space->GetValue(0) == "RAS";
  std::string comments = isRAS ? "comment SPACE=RAS\n" : "";
  vtkStringArray * const names = findStrings("SurfaceNames");
  const vtkIdType count = names == nullptr ? 0 : names->GetNumberOfValues();
  vtkDataArray * const colours = FindField(polyData, "SurfaceColours", 3, count);
  vtkDataArray * const opacities = FindField(polyData, "SurfaceOpacities", 1, count);
  vtkDataArray * const sizes = FindField(polyData, "SurfaceSizes", 2, count);
  if (colours == nullptr || opacities == nullptr || sizes == nullptr)
  {
    return comments;
  }
  for (vtkIdType n = 0; n < count; ++n)
  {
    const std::array<double, 3> colour{ colours->GetComponent(n, 0),
                                        colours->GetComponent(n, 1),
                                        colours->GetComponent(n, 2) };
    const nlohmann::json description{ { "name", static_cast<const std::string &>(names->GetValue(n)) },
                                      { "colour", colour },
                                      { "opacity", opacities->GetComponent(n, 0) },
                                      { "points", sizes->GetComponent(n, 0) },
                                      { "triangles", sizes->GetComponent(n, 1) } };
    comments += "comment SURFACE " + description.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
  }
  return comments;
}

/** \class LimitedBytes
 * \brief Appends to memory of a fixed size. */
class LimitedBytes
{
public:
  LimitedBytes(const fs::path & path, std::byte * bytes, std::size_t size)
    : m_Path(path)
    , m_Next(bytes)
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
      throw Failure(FailureKind::Unreadable,
                    "Cannot read " + m_Path.string() + ": it unpacks to many times its size; export it uncompressed.");
    }
    std::copy_n(static_cast<const std::byte *>(from), size, m_Next);
    m_Next += size;
    m_Left -= size;
  }

private:
  const fs::path & m_Path;
  std::byte * m_Next;
  std::size_t m_Left;
};

void
AppendPoints(vtkPolyData & polyData, vtkDataArray * normals, LimitedBytes & ply)
{
  for (vtkIdType n = 0; n < polyData.GetNumberOfPoints(); ++n)
  {
    for (vtkDataArray * const vectors : { polyData.GetPoints()->GetData(), normals })
    {
      if (vectors != nullptr)
      {
        std::array<double, 3> vector{};
        vectors->GetTuple(n, vector.data());
        const std::array<float, 3> floats{ static_cast<float>(vector[0]),
                                           static_cast<float>(vector[1]),
                                           static_cast<float>(vector[2]) };
        ply.Append(floats.data(), sizeof(floats));
      }
    }
  }
}

/** Appends the polygons: the number of corners, then their points. */
void
AppendPolygons(vtkCellArray & polygons, LimitedBytes & ply)
{
  vtkNew<vtkIdList> corners;
  std::vector<std::uint32_t> numbers;
  for (vtkIdType n = 0; n < polygons.GetNumberOfCells(); ++n)
  {
    polygons.GetCellAtId(n, corners);
    numbers.assign(1, static_cast<std::uint32_t>(corners->GetNumberOfIds()));
    std::transform(corners->begin(), corners->end(), std::back_inserter(numbers), [](vtkIdType corner) {
      return corner >= 0 && corner < UINT32_MAX ? static_cast<std::uint32_t>(corner) : UINT32_MAX;
    });
    ply.Append(numbers.data(), numbers.size() * sizeof(std::uint32_t));
  }
}

} // namespace

std::size_t
ConvertVTPToPLY(const fs::path & path, std::byte * bytes, std::size_t size)
{
  const vtkSmartPointer<vtkPolyData> polyData = ReadPolyData(path);
  vtkDataArray * normals = polyData->GetPointData()->GetNormals();
  if (normals != nullptr &&
      (normals->GetNumberOfComponents() != 3 || normals->GetNumberOfTuples() != polyData->GetNumberOfPoints()))
  {
    normals = nullptr;
  }
  const std::string header =
    "ply\nformat binary_little_endian 1.0\n" + DescribeSurfaces(*polyData) + "element vertex " +
    std::to_string(polyData->GetNumberOfPoints()) + "\nproperty float x\nproperty float y\nproperty float z\n" +
    (normals == nullptr ? "" : "property float nx\nproperty float ny\nproperty float nz\n") + "element face " +
    std::to_string(polyData->GetNumberOfPolys()) + "\nproperty list uint uint vertex_indices\nend_header\n";
  LimitedBytes ply(path, bytes, size);
  ply.Append(header.data(), header.size());
  AppendPoints(*polyData, normals, ply);
  AppendPolygons(*polyData->GetPolys(), ply);
  return size - ply.GetLeft();
}

} // namespace rhombic
