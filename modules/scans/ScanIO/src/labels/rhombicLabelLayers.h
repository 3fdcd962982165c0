#ifndef rhombicLabelLayers_h
#define rhombicLabelLayers_h

#include "rhombicMemoryBudget.h"
#include "rhombicScan.h"

#include "detail/itkHugePages.h"

#include <cstddef>
#include <cstdint>
#include <map>
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

  /** Sets Scan::image and Scan::furtherLayers. Returns the number of voxels that have several labels. */
  std::size_t
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
    return shared;
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

/** A note about voxels that have several labels. */
std::string
DescribeLayers(std::size_t sharedVoxels, const Scan & scan);

} // namespace rhombic

#endif
