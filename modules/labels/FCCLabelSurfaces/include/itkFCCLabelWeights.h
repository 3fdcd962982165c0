#ifndef itkFCCLabelWeights_h
#define itkFCCLabelWeights_h

#include "itkBulkAllocator.h"
#include "itkDataObject.h"
#include "itkObjectFactory.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace itk
{

/** \class FCCLabelWeights
 * \brief Weights of labels at the sites of an FCC image, for sites near walls only.
 *
 * A wall between two labels lies where their weights are equal. Weights are depths below the surface of the label's
 * region, positive inside, in any unit that is the same for all labels; they need to be known at the two ends of each
 * edge of the lattice between different labels, for both labels. A weight that is not stored counts as +Limit for the
 * label of the site and as -Limit for others.
 *
 * Rows are the rows of an image of labels, counted from the first: j + k height. A row has at most 65,535 sites.
 * Memory: 8 bytes a weight, 64 bytes a row, and one byte for each site of a row; in temporary files where there was a
 * rhombic::BulkInTemporaryFiles when the number of rows was set.
 *
 * Thread safety: different rows can be filled at once.
 *
 * \ingroup FCCLabelSurfaces
 */
class FCCLabelWeights : public DataObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCLabelWeights);

  using Self = FCCLabelWeights;
  using Superclass = DataObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCLabelWeights, DataObject);

  using LabelType = std::uint16_t;

  /** The weight of a label at the i-th site of a row. */
  struct Entry
  {
    std::uint16_t i;
    LabelType label;
    float weight;
  };
  using RowType = std::pmr::vector<Entry>;

  /** The size of weights that are not stored. */
  static constexpr float Limit = 3.0f;

  /** Exchanges all weights. */
  void
  Swap(FCCLabelWeights & other)
  {
    m_Memory.swap(other.m_Memory);
    m_Rows.swap(other.m_Rows);
    m_Begins.swap(other.m_Begins);
  }

  /** Removes all weights. */
  void
  SetNumberOfRows(SizeValueType rows);

  SizeValueType
  GetNumberOfRows() const
  {
    return m_Rows.size();
  }

  /** Adds a weight to a row; of a site and label, once. */
  void
  Add(SizeValueType row, const Entry & entry)
  {
    m_Rows[row].push_back(entry);
  }

  /** Sorts a row by sites and labels, as Find() needs it. */
  void
  SortRow(SizeValueType row);

  RowType &
  GetRow(SizeValueType row)
  {
    return m_Rows[row];
  }
  const RowType &
  GetRow(SizeValueType row) const
  {
    return m_Rows[row];
  }

  /** The weight of a label at a site, or null if it is not stored. */
  const float *
  Find(SizeValueType row, std::uint32_t i, LabelType label) const;

  /** Calls use(label, weight) for the weights that are stored at a site. */
  template <typename TUse>
  void
  ForEachAt(SizeValueType row, std::uint32_t i, const TUse & use) const
  {
    const BeginsType & begins = m_Begins[row];
    const std::uint32_t place = i / SitesPerBegin;
    for (std::uint32_t n = place + 1 < begins.size() ? begins[place] : 0;
         place + 1 < begins.size() && n < begins[place + 1];
         ++n)
    {
      if (const Entry & entry = m_Rows[row][n]; entry.i == i)
      {
        use(entry.label, entry.weight);
      }
    }
  }

  SizeValueType
  GetNumberOfWeights() const;

  void
  Initialize() override;

protected:
  FCCLabelWeights() = default;
  ~FCCLabelWeights() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  static constexpr std::uint32_t SitesPerBegin = 4;

  using BeginsType = std::pmr::vector<std::uint32_t>;

  std::shared_ptr<std::pmr::memory_resource> m_Memory; ///< of the entries and begins
  BulkVector<RowType> m_Rows;
  BulkVector<BeginsType> m_Begins; ///< of each row: the first entry of some sites, and the end
};

} // namespace itk

#endif
