#include "rhombicOMEZarrImage.h"

#include "rhombicOMEZarrMetadata.h"
#include "rhombicZarrArray.h"

#include <algorithm>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr std::size_t FirstOfSpace = MostZarrAxes - 3; ///< among the axes of arrays

/** A region of a frame in the array: where it begins, and its size. */
std::pair<ZarrNumbers, ZarrNumbers>
InArray(const ZarrNumbers & shape, std::size_t frame, const itk::ImageRegion<3> & region)
{
  ZarrNumbers begin{};
  ZarrNumbers size;
  size.fill(1);
  for (std::size_t axis = FirstOfSpace; axis-- > 0; frame /= shape[axis])
  {
    begin[axis] = frame % shape[axis];
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    begin[MostZarrAxes - 1 - axis] = static_cast<std::size_t>(region.GetIndex(axis));
    size[MostZarrAxes - 1 - axis] = region.GetSize(axis);
  }
  return { begin, size };
}

} // namespace

bool
IsZarr(const fs::path & folder)
{
  std::error_code error;
  const auto has = [&](const char * name) { return fs::exists(folder / name, error); };
  return has(".zattrs") || has(".zgroup") || has(".zarray") || has("zarr.json");
}

bool
HoldsOMEZarrImage(const fs::path & folder)
{
  try
  {
    return IsZarr(folder) && OMEZarrImage(folder).GetNumberOfLevels() > 0;
  }
  catch (const Failure & failure)
  {
    return failure.GetKind() != FailureKind::NotFound;
  }
}

OMEZarrImage::OMEZarrImage(const fs::path & folder, const OMEZarrOptions & options)
{
  const OMEZarrMetadata metadata = ReadOMEZarrMetadata(folder, options);
  const auto array = std::make_shared<const ZarrArray>(folder, metadata.array, options.followsLinks);
  if (array->GetNumberOfAxes() != metadata.numberOfAxes)
  {
    RefuseZarr(folder / metadata.array / ".zarray",
               "its array has another number of axes than the image; copy the folder again from its source");
  }
  m_Array = array;
  m_Metadata = { folder / ".zattrs", folder / metadata.array / ".zarray" };
  std::sort(m_Metadata.begin(), m_Metadata.end());
  m_NumberOfLevels = metadata.numberOfLevels;
  m_Notes = metadata.notes;
  const ZarrNumbers & shape = array->GetShape();
  for (std::size_t axis = 0; axis < FirstOfSpace; ++axis)
  {
    m_NumberOfFrames *= shape[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const OMEZarrAxis & stored = metadata.axes[2 - axis]; // the last axis of the array is the first of the volume
    m_Size[axis] = shape[MostZarrAxes - 1 - axis];
    m_Steps[axis].Fill(0);
    m_Steps[axis][stored.dimension] = *stored.step * *stored.millimetresPerUnit;
    m_Origin[stored.dimension] = stored.origin * *stored.millimetresPerUnit;
  }
}

OMEZarrImage::Type
OMEZarrImage::GetType() const
{
  return m_Array->GetType();
}

const std::string &
OMEZarrImage::GetEncoding() const
{
  return m_Array->GetEncoding();
}

std::size_t
OMEZarrImage::GetSlicesOfChunks() const
{
  return m_Array->GetChunk()[FirstOfSpace];
}

std::uintmax_t
OMEZarrImage::GetWorkingMemory() const
{
  return m_Array->GetWorkingMemory();
}

std::vector<fs::path>
OMEZarrImage::FindFiles(std::size_t frame) const
{
  const auto [begin, size] = InArray(m_Array->GetShape(), frame, m_Size);
  std::vector<fs::path> files = m_Array->FindChunks(begin, size);
  files.insert(files.end(), m_Metadata.begin(), m_Metadata.end());
  std::sort(files.begin(), files.end());
  return files;
}

void
OMEZarrImage::Read(std::size_t frame,
                   const itk::ImageRegion<3> & region,
                   void * buffer,
                   const ProgressFunction & progress) const
{
  const auto [begin, size] = InArray(m_Array->GetShape(), frame, region);
  m_Array->Read(begin, size, static_cast<std::byte *>(buffer), progress);
}

} // namespace rhombic
