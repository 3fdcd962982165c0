#include "rhombicFailure.h"
#include "rhombicLabelDoubts.h"
#include "rhombicPhantom.h"
#include "rhombicReadScan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace
{

namespace fs = std::filesystem;

/** Mirrors labels on their grid along axes, and then moves them along the grid's axes. */
struct Mistake
{
  std::array<bool, 3> mirrors;
  std::array<double, 3> millimetres;
};

const std::array<Mistake, 13> mistakes{ { { {}, { 15.0, 0.0, 0.0 } },
                                          { {}, { -15.0, 0.0, 0.0 } },
                                          { {}, { 0.0, 15.0, 0.0 } },
                                          { {}, { 0.0, -15.0, 0.0 } },
                                          { {}, { 0.0, 0.0, 15.0 } },
                                          { {}, { 0.0, 0.0, -15.0 } },
                                          { {}, { 30.0, 20.0, 0.0 } },
                                          { {}, { 0.0, -30.0, 8.0 } },
                                          { { true, false, false }, {} },
                                          { { false, true, false }, {} },
                                          { { false, false, true }, {} },
                                          { { true, true, false }, {} },
                                          { { true, false, true }, {} } } };

std::ostream &
operator<<(std::ostream & stream, const Mistake & mistake)
{
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    stream << (mistake.mirrors[axis] ? " mirrored" : " not") << " and moved by " << mistake.millimetres[axis] << " mm;";
  }
  return stream;
}

/** A copy of a map with its labels in other voxels of the same grid. */
rhombic::LabelMap
MoveLabels(const rhombic::LabelMap & map, const Mistake & mistake)
{
  rhombic::LabelMap moved = map;
  std::visit(
    [&](const auto & image) {
      using ImageType = std::decay_t<decltype(*image)>;
      const auto copy = ImageType::New();
      copy->CopyInformation(image);
      copy->SetRegions(image->GetBufferedRegion());
      copy->Allocate(true);
      const auto size = image->GetBufferedRegion().GetSize();
      for (std::size_t n = 0; n < image->GetBufferedRegion().GetNumberOfPixels(); ++n)
      {
        auto index = image->ComputeIndex(static_cast<itk::OffsetValueType>(n));
        bool isInside = true;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const auto last = static_cast<itk::IndexValueType>(size[axis]) - 1;
          index[axis] = (mistake.mirrors[axis] ? last - index[axis] : index[axis]) +
                        std::lround(mistake.millimetres[axis] / image->GetSpacing()[axis]);
          isInside = isInside && index[axis] >= 0 && index[axis] <= last;
        }
        if (isInside)
        {
          copy->SetPixel(index, image->GetBufferPointer()[n]);
        }
      }
      moved.scan.image = itk::SmartPointer<ImageType>(copy);
    },
    map.scan.image);
  return moved;
}

std::string
DoubtsOf(const rhombic::Scan & scan, const rhombic::LabelMap & map)
{
  std::string all;
  for (const std::string & doubt : rhombic::FindLabelDoubts(scan, map))
  {
    all += doubt + '\n';
  }
  return all;
}

class LabelDoubtsOfThePhantom : public testing::Test
{
protected:
  LabelDoubtsOfThePhantom()
  {
    rhombic::PhantomSettings settings;
    settings.spacing = 5.0;
    m_Scan.image = rhombic::MakePhantomScan(settings);
    m_Map.scan.image = rhombic::MakePhantomLabels(settings);
    m_Map.scan.format = "NIfTI";
    for (const rhombic::PhantomOrgan & organ : rhombic::PhantomOrgans())
    {
      rhombic::LabelSummary summary;
      summary.label.value = organ.label;
      summary.label.name = organ.name;
      m_Map.labels.push_back(summary);
    }
  }

  rhombic::Scan m_Scan;
  rhombic::LabelMap m_Map;
};

TEST_F(LabelDoubtsOfThePhantom, FurtherLayersCountToo)
{
  const auto bone = std::find_if(m_Map.labels.begin(), m_Map.labels.end(), [](const rhombic::LabelSummary & summary) {
    return summary.label.name.find("lung") != std::string::npos;
  });
  ASSERT_NE(bone, m_Map.labels.end());
  bone->label.name = "ribs";
  auto layer = itk::Image<std::uint8_t, 3>::New();
  std::visit(
    [&](const auto & image) {
      layer->CopyInformation(image);
      layer->SetRegions(image->GetBufferedRegion());
      layer->Allocate(true);
      for (std::size_t n = 0; n < image->GetBufferedRegion().GetNumberOfPixels(); ++n)
      {
        const bool isBone = static_cast<int>(image->GetBufferPointer()[n]) == bone->label.value;
        layer->GetBufferPointer()[n] = isBone ? static_cast<std::uint8_t>(bone->label.value) : 0;
        image->GetBufferPointer()[n] = isBone ? 0 : image->GetBufferPointer()[n];
      }
    },
    m_Map.scan.image);
  m_Map.scan.furtherLayers = { layer };
  EXPECT_NE(DoubtsOf(m_Scan, m_Map).find("ribs -"), std::string::npos) << DoubtsOf(m_Scan, m_Map);
}

TEST_F(LabelDoubtsOfThePhantom, NoneOfItsOwnLabels)
{
  EXPECT_EQ(DoubtsOf(m_Scan, m_Map), "");
}

TEST_F(LabelDoubtsOfThePhantom, LabelsInOtherPlaces)
{
  for (const Mistake & mistake : mistakes)
  {
    EXPECT_NE(DoubtsOf(m_Scan, MoveLabels(m_Map, mistake)), "") << mistake;
  }
}

TEST_F(LabelDoubtsOfThePhantom, NamesWhatIsOdd)
{
  const std::string inAir = DoubtsOf(m_Scan, MoveLabels(m_Map, { {}, { 0.0, 0.0, 150.0 } }));
  EXPECT_NE(inAir.find("HU"), std::string::npos) << inAir;
  const std::string mirrored = DoubtsOf(m_Scan, MoveLabels(m_Map, { { false, true, false }, {} }));
  EXPECT_NE(mirrored.find("mirrored from back to front"), std::string::npos) << mirrored;

  auto & labels = *std::get<itk::Image<std::uint8_t, 3>::Pointer>(m_Map.scan.image);
  const auto origin = labels.GetOrigin();
  labels.SetOrigin(origin + itk::Vector<double, 3>{ 25.0 });
  const std::string beside = DoubtsOf(m_Scan, m_Map);
  EXPECT_NE(beside.find("as many voxels as the scan"), std::string::npos) << beside;
  EXPECT_NE(beside.find("43.3 mm"), std::string::npos) << beside;
  labels.SetOrigin(origin);
  labels.SetSpacing(0.7 * labels.GetSpacing());
  const std::string small = DoubtsOf(m_Scan, m_Map);
  EXPECT_NE(small.find("covers 34 % of the scan's extent"), std::string::npos) << small;
}

struct Pair
{
  std::string scan; ///< in the folder of real scans
  std::string map;
};

class LabelDoubtsOfRealScans : public testing::Test
{
protected:
  void
  SetUp() override
  {
    const char * const scans = std::getenv("RHOMBIC_SCANS");
    if (scans == nullptr)
    {
      GTEST_SKIP() << "RHOMBIC_SCANS is not set";
    }
    m_Folder = scans;
  }

  rhombic::LabelMap
  Read(const Pair & pair, const rhombic::Scan & scan) const
  {
    return rhombic::ReadLabelMap({ { m_Folder / pair.map } }, {}, scan, m_Folder / pair.scan);
  }

  fs::path m_Folder;
};

const std::vector<Pair> wholeBodies{
  { "ct_body_totalseg_nifti/example_ct.nii.gz", "ct_body_totalseg_nifti/example_seg_fast_force_split.nii.gz" },
  { "ct_body_totalseg_nifti/example_ct_sm.nii.gz", "ct_body_totalseg_nifti/example_seg.nii.gz" },
  { "ct_body_totalseg_dicom_j2k", "ct_body_totalseg_nifti/example_seg_dicom.nii.gz" },
};

TEST_F(LabelDoubtsOfRealScans, NoneOfRightPairs)
{
  std::vector<Pair> pairs = wholeBodies;
  const std::string segmentations = "dicom_seg_dcmqi/segmentations/";
  for (const char * const map : { "liver.dcm",
                                  "liver_seg.nrrd",
                                  "spine_seg.nrrd",
                                  "heart_seg.nrrd",
                                  "liver_spine_seg.nrrd",
                                  "partial_overlaps.dcm" })
  {
    pairs.push_back({ segmentations + "ct-3slice", segmentations + map });
  }
  for (const std::string size : { "23x38x3", "24x38x3" })
  {
    pairs.push_back({ segmentations + size + "/image", segmentations + size + "/seg/label.seg" });
    pairs.push_back({ segmentations + size + "/image", segmentations + size + "/nrrd/label.nrrd" });
  }
  for (const Pair & pair : pairs)
  {
    const rhombic::Scan scan = rhombic::ReadScan(m_Folder / pair.scan);
    EXPECT_EQ(DoubtsOf(scan, this->Read(pair, scan)), "") << pair.scan << " with " << pair.map;
  }
}

TEST_F(LabelDoubtsOfRealScans, LabelsInOtherPlaces)
{
  for (const Pair & pair : wholeBodies)
  {
    const rhombic::Scan scan = rhombic::ReadScan(m_Folder / pair.scan);
    const rhombic::LabelMap map = this->Read(pair, scan);
    for (const Mistake & mistake : mistakes)
    {
      EXPECT_NE(DoubtsOf(scan, MoveLabels(map, mistake)), "") << pair.map << mistake;
    }
  }
}

TEST_F(LabelDoubtsOfRealScans, LabelsOfOtherScans)
{
  constexpr const char * scans[] = { "ct_body_totalseg_nifti/example_ct.nii.gz",
                                     "ct_body_totalseg_nifti/example_ct_sm.nii.gz",
                                     "ct_body_totalseg_nifti/ct_aorta_cropped.nii.gz",
                                     "ct_body_totalseg_dicom_j2k",
                                     "ct_mr_dicom2stl_nifti/ct_example.nii.gz" };
  constexpr const char * maps[] = { "ct_body_totalseg_nifti/example_seg_fast_force_split.nii.gz",
                                    "ct_body_totalseg_nifti/example_seg.nii.gz",
                                    "ct_body_totalseg_nifti/example_seg_dicom.nii.gz" };
  for (const char * const scanName : scans)
  {
    const rhombic::Scan scan = rhombic::ReadScan(m_Folder / scanName);
    for (const char * const mapName : maps)
    {
      const bool isRight = std::any_of(wholeBodies.begin(), wholeBodies.end(), [&](const Pair & pair) {
        return pair.scan == scanName && pair.map == mapName;
      });
      if (isRight)
      {
        continue;
      }
      try
      {
        EXPECT_NE(DoubtsOf(scan, this->Read({ scanName, mapName }, scan)), "") << scanName << " with " << mapName;
      }
      catch (const rhombic::Failure & failure)
      {
        EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Geometry) << "they lie apart";
      }
    }
  }
}

} // namespace
