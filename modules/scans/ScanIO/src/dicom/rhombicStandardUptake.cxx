#include "rhombicStandardUptake.h"

#include "rhombicDicomHeader.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <set>

namespace rhombic
{
namespace
{

constexpr double SecondsOfDay = 86400.0;

const std::set<DicomTag> UptakeTags{ DicomTags::Units,
                                     DicomTags::SUVType,
                                     DicomTags::CorrectedImage,
                                     DicomTags::DecayCorrection,
                                     DicomTags::PatientWeight,
                                     DicomTags::SeriesDate,
                                     DicomTags::SeriesTime,
                                     DicomTags::AcquisitionDate,
                                     DicomTags::AcquisitionTime,
                                     DicomTags::RadiopharmaceuticalStartTime,
                                     DicomTags::RadiopharmaceuticalStartDateTime,
                                     DicomTags::RadionuclideTotalDose,
                                     DicomTags::RadionuclideHalfLife };

/** Seconds since a day in the past of a date (DA) and a time (TM) of DICOM; nothing for other texts. */
std::optional<double>
ToSeconds(const std::string & date, const std::string & time)
{
  const auto number = [](const std::string & text, std::size_t begin) {
    const std::string digits = text.size() >= begin + 2 ? text.substr(begin, 2) : "";
    return digits.find_first_not_of("0123456789") == digits.npos ? ToNumber<int>(digits) : std::nullopt;
  };
  const auto century = number(date, 0), year = number(date, 2), month = number(date, 4), day = number(date, 6);
  const auto hours = number(time, 0), minutes = number(time, 2), seconds = number(time, 4);
  if (date.size() != 8 || !century || !year || !month || !day || !hours || !minutes)
  {
    return {};
  }
  const auto fraction = time.size() > 6 ? ToNumber<double>("0" + time.substr(6)) : std::optional<double>(0.0);
  if ((time.size() > 4 && !seconds) || !fraction)
  {
    return {};
  }
  std::tm at{};
  at.tm_year = 100 * *century + *year - 1900;
  at.tm_mon = *month - 1;
  at.tm_mday = *day;
  return static_cast<double>(timegm(&at)) + 3600.0 * *hours + 60.0 * *minutes + seconds.value_or(0) + *fraction;
}

/** A positive number; nothing if it is missing, 0 or none. */
std::optional<double>
PositiveAt(const DicomDataSet & dataSet, DicomTag tag)
{
  const std::vector<double> numbers = dataSet.GetDecimals(tag);
  return !numbers.empty() && numbers.front() > 0.0 ? std::optional(numbers.front()) : std::nullopt;
}

/** The seconds at which a scan began: see FindStandardUptake(). */
std::optional<double>
FindStart(const Scan & scan, const DicomDataSet & first)
{
  const auto series = ToSeconds(first.GetText(DicomTags::SeriesDate), first.GetText(DicomTags::SeriesTime));
  double earliest = std::numeric_limits<double>::infinity();
  for (const auto & file : scan.files)
  {
    const auto header = ReadDicomHeader(file, { DicomTags::AcquisitionDate, DicomTags::AcquisitionTime });
    const auto acquired = header ? ToSeconds(header->dataSet.GetText(DicomTags::AcquisitionDate),
                                             header->dataSet.GetText(DicomTags::AcquisitionTime))
                                 : std::nullopt;
    if (!acquired)
    {
      return {};
    }
    earliest = std::min(earliest, *acquired);
  }
  return series && *series <= earliest ? *series : earliest;
}

/** The seconds from the injection to the scan's start; nothing if they are unknown or make no sense. */
std::optional<double>
FindDecayTime(const Scan & scan, const DicomDataSet & first, const DicomDataSet & injection)
{
  const auto start = FindStart(scan, first);
  if (!start)
  {
    return {};
  }
  const std::string dateTime = injection.GetText(DicomTags::RadiopharmaceuticalStartDateTime);
  std::optional<double> injected;
  if (dateTime.size() > 8)
  {
    injected = ToSeconds(dateTime.substr(0, 8), dateTime.substr(8, dateTime.find_first_of("+-") - 8));
  }
  else
  {
    injected =
      ToSeconds(first.GetText(DicomTags::SeriesDate), injection.GetText(DicomTags::RadiopharmaceuticalStartTime));
    if (injected && *injected > *start)
    {
      *injected -= SecondsOfDay; // before midnight
    }
  }
  const bool isSensible = injected && *start - *injected >= 0.0 && *start - *injected < SecondsOfDay;
  return isSensible ? std::optional(*start - *injected) : std::nullopt;
}

} // namespace

StandardUptake
FindStandardUptake(const Scan & scan)
{
  if (scan.format != "DICOM" || scan.files.empty())
  {
    return { {}, "only headers of DICOM tell it" };
  }
  const auto header = ReadDicomHeader(scan.files.front(), UptakeTags);
  const DicomDataSet none;
  const DicomDataSet & first = header ? header->dataSet : none;
  const std::string units = first.GetText(DicomTags::Units);
  const std::string type = first.GetText(DicomTags::SUVType);
  if (units == "GML")
  {
    return type.empty() || type == "BW" ? StandardUptake{ 1.0, "" }
                                        : StandardUptake{ {}, "its values are SUV of another type" };
  }
  if (units != "BQML")
  {
    return { {}, "its values are not in Bq/ml" };
  }
  const std::string corrections = first.GetText(DicomTags::CorrectedImage);
  const auto isCorrected = [&corrections](const char * word) { return corrections.find(word) != corrections.npos; };
  if (!isCorrected("ATTN") || !(isCorrected("DECY") || isCorrected("DECAY")))
  {
    return { {}, "corrections for attenuation and decay are not named" };
  }
  const std::string decay = first.GetText(DicomTags::DecayCorrection);
  if (decay != "START" && decay != "ADMIN")
  {
    return { {}, "the time that decay is corrected to is neither START nor ADMIN" };
  }
  const DicomDataSet & injection = first.GetItem(DicomTags::RadiopharmaceuticalInformationSequence);
  const auto weight = PositiveAt(first, DicomTags::PatientWeight); // kg
  const auto dose = PositiveAt(injection, DicomTags::RadionuclideTotalDose);
  const auto halfLife = PositiveAt(injection, DicomTags::RadionuclideHalfLife);
  if (!weight || !dose || !halfLife)
  {
    return { {},
             (!weight ? "the patient's weight"
              : !dose ? "the injected dose"
                      : "the half-life") +
               std::string(" is missing") };
  }
  const auto time = decay == "ADMIN" ? std::optional<double>(0.0) : FindDecayTime(scan, first, injection);
  if (!time)
  {
    return { {}, "the time from the injection to the scan is unknown" };
  }
  constexpr double gramsPerKilogram = 1000.0;
  return { gramsPerKilogram * *weight / (*dose * std::exp2(-*time / *halfLife)), "" };
}

} // namespace rhombic
