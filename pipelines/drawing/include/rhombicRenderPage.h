#ifndef rhombicRenderPage_h
#define rhombicRenderPage_h

#include "rhombicRenderScan.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** From a scan or surface files to an interactive page. */
struct RenderPageSettings : PictureSettings
{
  std::vector<View> views{ StandardViews()[0],
                           StandardViews()[2],
                           StandardViews()[1],
                           StandardViews()[3] }; ///< still pictures
  std::string title;                             ///< empty: the names of few surfaces, or the number of many
  bool hasSlices = true;                         ///< without effect where there is no scan
  std::uintmax_t largestSize = 8'000'000;        ///< bytes; see PageContent
  std::filesystem::path page;                    ///< .html
};

/** Whether a path is that of an interactive page: its extension is .html or .htm. */
bool
IsPagePath(const std::filesystem::path & path);

/** Checks as CheckRenderScan() does. Returns the files of the page. */
std::vector<std::filesystem::path>
CheckRenderPage(const RenderPageSettings & settings);

/** Makes one HTML file in which surfaces can be turned and hidden and slices scrolled, see MakeInteractivePage().
 * Returns all files. Throws as RenderScan() does.
 *
 * \param volume the scan's volume, if the caller has read the scan already */
std::vector<MadeFile>
RenderPage(const RenderPageSettings & settings,
           const Events & events,
           std::optional<SourceVolume> volume = std::nullopt);

/** As PlanRenderScan(). */
std::string
PlanRenderPage(const RenderPageSettings & settings, const Events & events);

} // namespace rhombic

#endif
