#include "rhombicLabelLayers.h"

#include "rhombicFailure.h"
#include "rhombicLabelMap.h"

#include <algorithm>
#include <limits>

namespace rhombic
{

std::uint16_t
LabelUnion::NumberFor(std::int32_t value) const
{
  constexpr int largest = std::numeric_limits<std::uint16_t>::max();
  if (value > 0 && value <= largest && m_Labels.count(static_cast<std::uint16_t>(value)) == 0)
  {
    return static_cast<std::uint16_t>(value);
  }
  int number = m_Labels.empty() ? 1 : m_Labels.rbegin()->first + 1;
  for (int lower = 1; number > largest; ++lower) // the largest is taken: the lowest that is free
  {
    number = m_Labels.count(static_cast<std::uint16_t>(lower)) == 0 ? lower : number;
  }
  return static_cast<std::uint16_t>(number);
}

bool
LabelUnion::Add(const ScanImage & map, const LabelTable & table, const std::optional<std::string> & maskName)
{
  Scan scan;
  scan.image = map;
  const std::vector<LabelSummary> labels = SummarizeLabels(scan, table);
  std::map<std::int32_t, std::uint16_t> numbers;
  for (const LabelSummary & summary : labels)
  {
    Label label = summary.label;
    const bool isNamed =
      std::any_of(table.begin(), table.end(), [&label](const Label & known) { return known.value == label.value; });
    const bool isMask = maskName && IsMask(labels) && !isNamed;
    const std::uint16_t number = this->NumberFor(isMask && label.value == 255 ? 1 : label.value);
    numbers[label.value] = number;
    label.value = number;
    label = isNamed ? label : NamedLabel(number, isMask ? *maskName : "");
    constexpr std::size_t most = 4096;
    if (m_Labels.insert({ number, label }); m_Labels.size() > most)
    {
      throw Failure(FailureKind::Unreadable, "There can be 4096 labels; name fewer label maps.");
    }
  }
  std::visit(
    [&](const auto & image) {
      const auto * const begin = image->GetBufferPointer();
      const auto * const end = begin + image->GetBufferedRegion().GetNumberOfPixels();
      m_Layers.Add([&](const auto & add) {
        std::uint16_t number = 0;
        for (const auto * pixel = begin; pixel != end; ++pixel)
        {
          if (*pixel == 0)
          {
            continue;
          }
          if (pixel == begin || *pixel != pixel[-1])
          {
            number = numbers.at(static_cast<std::int32_t>(*pixel));
          }
          add(static_cast<std::size_t>(pixel - begin), number);
        }
      });
    },
    map);
  return !labels.empty();
}

void
LabelUnion::Take(Scan & scan)
{
  m_Layers.Take(scan);
  scan.labels.clear();
  for (const auto & [number, label] : m_Labels)
  {
    scan.labels.push_back(label);
  }
}

} // namespace rhombic
