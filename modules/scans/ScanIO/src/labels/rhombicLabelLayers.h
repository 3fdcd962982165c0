#ifndef rhombicLabelLayers_h
#define rhombicLabelLayers_h

#include "rhombicLabelTable.h"
#include "rhombicMemoryBudget.h"
#include "rhombicScan.h"
#include "rhombicWording.h"

#include "itkRecyclingMemory.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** \class LabelLayers
 * \brief Puts labels that may overlap into label maps of one grid: each label into the first one in which no other
 * label has one of its voxels. */
template <typename TPixel>
class LabelLayers
{
public:
  using ImageType = itk::Image<TPixel, 3>;

  /** \param grid of all layers
   * \param maximumMemory of all layers, in bytes; 0: half of the free memory for each */
  LabelLayers(const itk::ImageBase<3> & grid, std::uintmax_t maximumMemory)
    : m_Grid(&grid)
    , m_MaximumMemory(maximumMemory)
  {}

  /** Adds labels that do not overlap each other and were not added before. \a visit is called twice with a function of
   * a voxel's offset and its label, and calls that for each voxel of the labels. Throws Failure(Memory). */
  template <typename TVisit>
  void
  Add(const TVisit & visit)
  {
    std::map<TPixel, std::vector<bool>> isTaken; // by label and layer
    visit([&](std::size_t voxel, TPixel label) {
      for (std::size_t layer = 0; layer < m_Layers.size(); ++layer)
      {
        if (m_Layers[layer]->GetBufferPointer()[voxel] != 0)
        {
          std::vector<bool> & layers = isTaken[label];
          layers.resize(m_Layers.size());
          layers[layer] = true;
        }
      }
    });
    std::map<TPixel, TPixel *> places; // by label: the voxels of its layer
    TPixel last = 0;
    TPixel * pixels = nullptr;
    visit([&](std::size_t voxel, TPixel label) {
      if (label != last)
      {
        last = label;
        TPixel *& place = places[label];
        place = place == nullptr ? this->FindLayer(isTaken[label]) : place;
        pixels = place;
      }
      pixels[voxel] = label;
    });
  }

  /** Sets Scan::image and Scan::furtherLayers, and adds a note if voxels have several labels. */
  void
  Take(Scan & scan)
  {
    if (m_Layers.empty())
    {
      this->AddLayer();
    }
    std::size_t shared = 0;
    const std::size_t voxels = m_Layers.front()->GetBufferedRegion().GetNumberOfPixels();
    for (std::size_t voxel = 0; m_Layers.size() > 1 && voxel < voxels; ++voxel)
    {
      unsigned int labels = 0;
      for (const auto & layer : m_Layers)
      {
        labels += layer->GetBufferPointer()[voxel] != 0 ? 1 : 0;
      }
      shared += labels > 1 ? 1 : 0;
    }
    scan.image = m_Layers.front();
    scan.furtherLayers.assign(m_Layers.begin() + 1, m_Layers.end());
    if (shared > 0)
    {
      scan.notes.push_back(Count(shared, "voxel belongs", "voxels belong") +
                           " to more than one label; labels are whole, in " + std::to_string(m_Layers.size()) +
                           " layers.");
    }
  }

private:
  /** The voxels of the first layer that is not taken. */
  TPixel *
  FindLayer(std::vector<bool> isTaken)
  {
    isTaken.resize(m_Layers.size());
    std::size_t layer = 0;
    while (layer < isTaken.size() && isTaken[layer])
    {
      ++layer;
    }
    // A layer that labels of this call have begun is free for others of them.
    if (layer == m_Layers.size())
    {
      this->AddLayer();
    }
    return m_Layers[layer]->GetBufferPointer();
  }

  void
  AddLayer()
  {
    const std::uintmax_t bytes = m_Grid->GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(TPixel);
    RequireMemory(m_MaximumMemory > 0 ? bytes * (m_Layers.size() + 1) : bytes,
                  m_MaximumMemory,
                  "Layer " + std::to_string(m_Layers.size() + 1) + " of labels that overlap",
                  "read fewer of them, or crop them");
    const auto layer = ImageType::New();
    layer->CopyInformation(m_Grid);
    layer->SetRegions(m_Grid->GetLargestPossibleRegion());
    layer->Allocate();
    itk::AdviseHugePages(layer->GetBufferPointer(), layer->GetPixelContainer()->Size() * sizeof(TPixel));
    layer->FillBuffer(0);
    m_Layers.push_back(layer);
  }

  itk::ImageBase<3>::ConstPointer m_Grid;
  std::uintmax_t m_MaximumMemory;
  std::vector<typename ImageType::Pointer> m_Layers;
};

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
