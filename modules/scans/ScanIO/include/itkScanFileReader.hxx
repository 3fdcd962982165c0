#ifndef itkScanFileReader_hxx
#define itkScanFileReader_hxx

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkMetaDataObject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace itk
{

template <typename TOutputImage>
void
ScanFileReader<TOutputImage>::GenerateOutputInformation()
{
  Superclass::GenerateOutputInformation();
  m_EarlyScan = {};
  if (this->GetAcceptGaps())
  {
    m_EarlyScan = this->ReadVoxels();
    if (!this->GetAcceptUneven() && !m_EarlyScan.sliceOrigins.empty())
    {
      m_EarlyScan = {};
      throw rhombic::Failure(
        rhombic::FailureKind::Geometry,
        std::string("Cannot read ") + this->GetFileName() +
          " as an image: slices are missing, and no ITK image holds the places of the others; call "
          "reader->AcceptUnevenOn() and lattice->SetScan(reader->GetScan()).");
    }
  }
  const ImageBase<3> & frame = rhombic::GeometryOf(this->GetScan().image);
  this->GetOutput()->CopyInformation(&frame);
  this->DescribeOutput(frame.GetMetaDataDictionary());
}

template <typename TOutputImage>
void
ScanFileReader<TOutputImage>::DescribeOutput(const MetaDataDictionary & placement)
{
  MetaDataDictionary dictionary = placement;
  for (const auto & [key, text] : rhombic::SummarizeScan(this->GetScan()))
  {
    EncapsulateMetaData<std::string>(dictionary, key, text);
  }
  this->GetOutput()->SetMetaDataDictionary(dictionary);
}

template <typename TOutputImage>
void
ScanFileReader<TOutputImage>::EnlargeOutputRequestedRegion(DataObject * output)
{
  Superclass::EnlargeOutputRequestedRegion(output);
  output->SetRequestedRegionToLargestPossibleRegion();
}

template <typename TOutputImage>
void
ScanFileReader<TOutputImage>::GenerateData()
{
  rhombic::Scan scan = std::exchange(m_EarlyScan, {});
  if (scan.format.empty())
  {
    scan = this->ReadVoxels();
  }
  if (rhombic::GeometryOf(scan.image).GetLargestPossibleRegion() != this->GetOutput()->GetLargestPossibleRegion())
  {
    throw rhombic::Failure(rhombic::FailureKind::Unreadable,
                           std::string("Cannot read ") + this->GetFileName() +
                             ": its files changed while they were read; read it again.");
  }
  if (!scan.furtherLayers.empty())
  {
    throw rhombic::Failure(rhombic::FailureKind::Usage,
                           std::string("Cannot read ") + this->GetFileName() +
                             " as one image: its labels overlap; read its layers with rhombic::ReadLabelMap().");
  }
  this->Inspect(scan);
  std::visit([this](const auto & voxels) { this->TakeVoxels(*voxels); }, scan.image);
}

template <typename TOutputImage>
template <typename TPixel>
void
ScanFileReader<TOutputImage>::TakeVoxels(Image<TPixel, 3> & voxels)
{
  TOutputImage * const output = this->GetOutput();
  const TPixel * const begin = voxels.GetBufferPointer();
  const TPixel * const end = begin + voxels.GetBufferedRegion().GetNumberOfPixels();
  this->DescribeOutput(voxels.GetMetaDataDictionary());
  if constexpr (std::is_same_v<TOutputImage, Image<TPixel, 3>>)
  {
    output->SetBufferedRegion(voxels.GetBufferedRegion());
    output->SetPixelContainer(voxels.GetPixelContainer());
  }
  else
  {
    this->AllocateOutputs();
    std::transform(begin, end, output->GetBufferPointer(), [this](TPixel value) {
      // Any of the five pixel types of scans is exact in double.
      using Limits = std::numeric_limits<OutputPixelType>;
      const auto exact = static_cast<double>(value);
      const bool isInRange = !Limits::is_integer || (exact >= static_cast<double>(Limits::lowest()) &&
                                                     exact < std::ldexp(1.0, Limits::digits));
      const auto converted = static_cast<OutputPixelType>(isInRange ? exact : 0.0);
      if (!isInRange || static_cast<double>(converted) != exact)
      {
        throw rhombic::Failure(rhombic::FailureKind::Usage,
                               std::string("Cannot read ") + this->GetFileName() + " as " +
                                 rhombic::PixelTypeName<OutputPixelType>() + ": it holds " +
                                 rhombic::FormatExact(exact) + ", and is " + rhombic::PixelTypeName<TPixel>() +
                                 " itself; read it as that.");
      }
      return converted;
    });
  }
}

} // namespace itk

#endif
