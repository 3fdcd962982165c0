#include "rhombicDicomStack.h"
#include "rhombicFailure.h"
#include "rhombicFuzzBytes.h"
#include "rhombicFuzzProperty.h"

#include <cmath>
#include <set>

using rhombic::DicomSeries;
using rhombic::DicomSlice;
using rhombic::DicomStack;
using rhombic::ScanReadOptions;
using rhombicfuzz::FuzzBytes;
using rhombicfuzz::Require;

namespace
{

std::shared_ptr<const rhombic::DicomImageFile>
MakeFile(FuzzBytes & bytes, std::size_t number)
{
  const auto file = std::make_shared<rhombic::DicomImageFile>();
  const char * const folders[]{ "a", "a", "b", "c" };
  file->path = std::filesystem::path(folders[bytes.TakeBelow(4)]) / std::to_string(number);
  file->format.columns = bytes.TakeBelow(16) == 1 ? 5 : 4;
  file->format.rows = 4;
  return file;
}

/** The number-th slice of a stack along z unless the bytes say otherwise. */
DicomSlice
MakeSlice(FuzzBytes & bytes, std::size_t number)
{
  const char * const uids[]{ "1.2", "1.3", "" };
  const char * const numbers[]{ "1", "", "-", "99999999999999999999" };
  DicomSlice slice;
  slice.file = MakeFile(bytes, number);
  const std::size_t uid = bytes.TakeBelow(32);
  slice.seriesUID = uids[uid < 3 ? uid : 0];
  slice.seriesNumber = numbers[bytes.TakeBelow(32) % 4];
  slice.kind = static_cast<DicomSlice::Kind>(bytes.TakeBelow(32) == 1 ? 1 : 0);
  slice.refusal = bytes.TakeBelow(64) == 1 ? "it is refused" : "";
  slice.distinctions[bytes.TakeBelow(DicomSlice::NumberOfDistinctions)] = std::string(bytes.TakeBelow(3), 'x');

  const std::vector<double> position{ bytes.TakeNumber(0),
                                      bytes.TakeNumber(0),
                                      bytes.TakeNumber(static_cast<double>(number)) };
  std::vector<double> orientation{ 1, 0, 0, 0, 1, 0 };
  for (double & cosine : orientation)
  {
    cosine = bytes.TakeNumber(cosine);
  }
  const std::vector<double> spacing{ bytes.TakeNumber(0.5), bytes.TakeNumber(0.5) };
  slice.plane = rhombic::MakeSlicePlane(position, orientation, spacing, slice.planeProblem);
  Require(slice.plane.has_value() == slice.planeProblem.empty(), "a slice has a plane or a problem");
  return slice;
}

/** Distance of a slice from its place on the affine grid. */
double
DistanceFromGrid(const DicomStack & stack, const DicomSlice & slice, std::size_t index)
{
  itk::Vector<double, 3> off = slice.plane->position - stack.geometry.origin;
  for (unsigned int row = 0; row < 3; ++row)
  {
    off[row] -= stack.geometry.direction[row][2] * stack.geometry.spacing[2] * static_cast<double>(index);
  }
  return off.GetNorm();
}

void
CheckStack(const DicomStack & stack, const std::vector<DicomSlice> & slices)
{
  Require(stack.geometry.size[2] == slices.size(), "every slice is in the volume");
  Require(std::isfinite(stack.report.tiltDegrees), "the tilt is a number");
  const double mean = (stack.report.lastPosition - stack.report.firstPosition) / static_cast<double>(slices.size() - 1);
  Require(std::isfinite(mean) && mean > 0, "slices follow each other along the normal");
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    Require(std::isfinite(stack.geometry.origin[axis]), "the origin is finite");
    Require(std::isfinite(stack.geometry.spacing[axis]) && stack.geometry.spacing[axis] > 0, "spacings are positive");
  }
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    const double rounding = 1e-12 * slices[i].plane->position.GetVectorFromOrigin().GetNorm();
    Require(!stack.sliceOrigins.empty() || DistanceFromGrid(stack, slices[i], i) <= 0.0101 + rounding,
            "slices of an even stack are on its grid");
    Require(stack.sliceOrigins.empty() || stack.sliceOrigins.at(i) == slices[i].plane->position,
            "slices of an uneven stack are where they were");
  }
}

void
Stack(const DicomSeries & series, ScanReadOptions::Policy policy)
{
  ScanReadOptions options;
  options.onTilted = policy;
  options.onUneven = policy;
  options.onGap = policy;
  try
  {
    std::vector<DicomSlice> slices = series.slices;
    const DicomStack stack = StackSlices(slices, options);
    CheckStack(stack, slices);
    Require(policy == ScanReadOptions::Policy::Accept || stack.sliceOrigins.empty(), "uneven stacks can be refused");
  }
  catch (const rhombic::Failure &)
  {}
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  FuzzBytes bytes(data, size);
  const std::size_t count = 1 + bytes.TakeBelow(64);
  const std::size_t wanted = bytes.TakeBelow(8);
  std::vector<DicomSlice> slices;
  while (slices.size() < count)
  {
    slices.push_back(MakeSlice(bytes, slices.size()));
  }
  const std::vector<DicomSeries> series = rhombic::GroupIntoSeries(slices);
  std::size_t grouped = 0;
  std::set<std::string> ids;
  for (const DicomSeries & one : series)
  {
    grouped += one.slices.size();
    ids.insert(one.id);
    Stack(one, ScanReadOptions::Policy::Refuse);
    Stack(one, ScanReadOptions::Policy::Accept);
  }
  Require(grouped == slices.size(), "every slice is in one series");
  Require(ids.size() == series.size(), "every series has an id of its own");
  try
  {
    const std::string name = wanted == 0 ? "" : std::to_string(wanted);
    Require(ChooseSeries(series, name, "folder").index < series.size(), "the chosen series exists");
  }
  catch (const rhombic::Failure &)
  {}
  Summarize(series, 0);
  return 0;
}
