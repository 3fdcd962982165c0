#ifndef rhombicLabelUnion_h
#define rhombicLabelUnion_h

#include "rhombicLabelLayers.h"
#include "rhombicLabelTable.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace rhombic
{

/** \class LabelUnion
 * \brief Joins label maps of one grid into one, of layers where labels overlap.
 *
 * A label keeps its value, from 1 to 65,535, if no label before it has the same; otherwise it gets the number after the
 * largest one so far. */
class LabelUnion
{
public:
  /** As LabelLayers. */
  LabelUnion(const itk::ImageBase<3> & grid, std::uintmax_t maximumMemory)
    : m_Layers(grid, maximumMemory)
  {}

  /** Adds a label map, whose labels are called as \a table says. \a maskName is the name of the label of a mask (see
   * IsMask()) if the table lacks it; its value 255 then counts as 1. Returns whether there was any label. Throws
   * Failure: Unreadable for values that are no whole numbers and for more than 4096 labels, Memory. */
  bool
  Add(const ScanImage & map, const LabelTable & table, const std::optional<std::string> & maskName = {});

  /** Sets image, layers and labels of a scan, and adds a note about labels that overlap. */
  void
  Take(Scan & scan);

private:
  std::uint16_t
  NumberFor(std::int32_t value) const;

  LabelLayers<std::uint16_t> m_Layers;
  std::map<std::uint16_t, Label> m_Labels;
};

} // namespace rhombic

#endif
