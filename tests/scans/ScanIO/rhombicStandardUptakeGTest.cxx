#include "rhombicStandardUptake.h"

#include "rhombicDicomTestFile.h"
#include "rhombicScanTest.h"

#include <cmath>

namespace
{

constexpr std::uint32_t Units = 0x00541001, SUVType = 0x00541006, DecayCorrection = 0x00541102,
                        CorrectedImage = 0x00280051, PatientWeight = 0x00101030, SeriesDate = 0x00080021,
                        SeriesTime = 0x00080031, AcquisitionDate = 0x00080022, AcquisitionTime = 0x00080032,
                        Injection = 0x00540016, StartTime = 0x00181072, StartDateTime = 0x00181078, Dose = 0x00181074,
                        HalfLife = 0x00181075;

constexpr double HalfLifeOfFluorine = 6586.2; // s

/** Changes of a complete header; the second is of the sequence about the injection. */
using Change = std::function<void(DicomTestDataSet & file, DicomTestDataSet & injection)>;

class StandardUptake : public ScanTest
{
protected:
  /** A PET of 370 MBq, injected an hour before the scan, of a patient of 70 kg, in two slices. */
  rhombic::StandardUptake
  Find(const Change & change = [](auto &, auto &) {}) const
  {
    for (int slice = 0; slice < 2; ++slice)
    {
      DicomTestFile file(4, 4);
      file.SetText(0x00080060, "CS", "PT");
      file.SetPosition("0\\0\\" + std::to_string(slice));
      file.SetText(Units, "CS", "BQML");
      file.SetText(DecayCorrection, "CS", "START");
      file.SetText(CorrectedImage, "CS", "DECY\\ATTN\\SCAT");
      file.SetText(PatientWeight, "DS", "70");
      file.SetText(SeriesDate, "DA", "20240229");
      file.SetText(SeriesTime, "TM", "100000.500");
      file.SetText(AcquisitionDate, "DA", "20240229");
      file.SetText(AcquisitionTime, "TM", "1005");
      DicomTestDataSet injection;
      injection.SetText(StartTime, "TM", "090000.500");
      injection.SetText(Dose, "DS", "3.7e8");
      injection.SetText(HalfLife, "DS", "6586.2");
      change(file, injection);
      file.SetItems(Injection, { injection });
      file.Write(m_Folder / ("slice" + std::to_string(slice) + ".dcm"));
    }
    return rhombic::FindStandardUptake(rhombic::ReadScan(m_Folder));
  }

  void
  ExpectFactorAfter(double seconds, const Change & change) const
  {
    const rhombic::StandardUptake found = this->Find(change);
    ASSERT_TRUE(found.factor) << found.reason;
    const double left = 3.7e8 * std::pow(0.5, seconds / HalfLifeOfFluorine);
    EXPECT_NEAR(*found.factor, 70'000.0 / left, 1e-9 * 70'000.0 / left);
  }

  void
  ExpectNone(const std::string & reason, const Change & change) const
  {
    const rhombic::StandardUptake found = this->Find(change);
    EXPECT_FALSE(found.factor);
    EXPECT_NE(found.reason.find(reason), std::string::npos) << found.reason;
  }
};

TEST_F(StandardUptake, DecaysFromTheInjectionToTheScan)
{
  ExpectFactorAfter(3600.0, [](auto &, auto &) {});
}

TEST_F(StandardUptake, OfValuesCorrectedToTheInjectionDoesNotDecay)
{
  ExpectFactorAfter(0.0, [](auto & file, auto & injection) {
    file.SetText(DecayCorrection, "CS", "ADMIN");
    injection.Remove(StartTime);
  });
}

TEST_F(StandardUptake, KnowsInjectionsBeforeMidnight)
{
  ExpectFactorAfter(3600.0, [](auto & file, auto & injection) {
    file.SetText(SeriesTime, "TM", "003000");
    injection.SetText(StartTime, "TM", "233000");
  });
  ExpectFactorAfter(3600.0, [](auto & file, auto & injection) {
    file.SetText(SeriesDate, "DA", "20240301"); // behind a leap day
    file.SetText(AcquisitionDate, "DA", "20240301");
    file.SetText(SeriesTime, "TM", "003000");
    injection.SetText(StartDateTime, "DT", "20240229233000.0");
    injection.SetText(StartTime, "TM", "120000"); // has no date
  });
}

TEST_F(StandardUptake, OfAProcessedSeriesDecaysToTheEarliestAcquisition)
{
  ExpectFactorAfter(3899.5, [](auto & file, auto &) { file.SetText(SeriesTime, "TM", "180000"); });
}

TEST_F(StandardUptake, IsTheValueItselfInGramsPerMillilitre)
{
  const auto found = this->Find([](auto & file, auto &) { file.SetText(Units, "CS", "GML"); });
  EXPECT_EQ(found.factor, 1.0);
  ExpectNone("another type", [](auto & file, auto &) {
    file.SetText(Units, "CS", "GML");
    file.SetText(SUVType, "CS", "LBM");
  });
}

TEST_F(StandardUptake, NeedsAllOfItsParts)
{
  ExpectNone("not in Bq/ml", [](auto & file, auto &) { file.SetText(Units, "CS", "CNTS"); });
  ExpectNone("weight", [](auto & file, auto &) { file.Remove(PatientWeight); });
  ExpectNone("weight", [](auto & file, auto &) { file.SetText(PatientWeight, "DS", "0"); });
  ExpectNone("dose", [](auto &, auto & injection) { injection.Remove(Dose); });
  ExpectNone("half-life", [](auto &, auto & injection) { injection.SetText(HalfLife, "DS", "x"); });
  ExpectNone("START", [](auto & file, auto &) { file.SetText(DecayCorrection, "CS", "NONE"); });
  ExpectNone("corrections", [](auto & file, auto &) { file.SetText(CorrectedImage, "CS", "DECY"); });
  ExpectNone("corrections", [](auto & file, auto &) { file.Remove(CorrectedImage); });
  ExpectNone("time", [](auto &, auto & injection) { injection.Remove(StartTime); });
  ExpectNone("time", [](auto & file, auto &) { file.Remove(AcquisitionTime); });
  ExpectNone("time", [](auto &, auto & injection) { injection.SetText(StartDateTime, "DT", "20240226090000"); });
  ExpectNone("time", [](auto &, auto & injection) { injection.SetText(StartTime, "TM", "9 h"); });
}

TEST_F(StandardUptake, IsUnknownWithoutDicom)
{
  const rhombic::StandardUptake found = rhombic::FindStandardUptake(rhombic::Scan());
  EXPECT_FALSE(found.factor);
  EXPECT_FALSE(found.reason.empty());
}

} // namespace
