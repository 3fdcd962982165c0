#ifndef rhombicRenderAgreement_h
#define rhombicRenderAgreement_h

#include "rhombicCompareLabels.h"

#include <optional>

namespace rhombic
{

/** Throws Failure(Usage) for a page that is no .png, .jpg, .tif, .pdf or .html, and for a range that is not above 0. */
void
CheckAgreementPage(const CompareLabelsSettings & settings, const std::optional<double> & range);

/** Draws the page of an agreement, and returns its files: A's surfaces, coloured by their signed distances from B's;
 * slices with the areas of A; lines where B's surfaces are; and a table of the labels, those of which one segmentation
 * has none and the largest distances first. An interactive page (.html) has B's surfaces, hidden at first. Throws as
 * RenderSheet() does; Empty if A has no surface. \param labels of CompareLabels() with the same settings \param range
 * the largest distance in mm that has a colour of its own; nothing: what 95 % of the points have */
std::vector<MadeFile>
RenderAgreement(const CompareLabelsSettings & settings,
                const std::vector<LabelAgreement> & labels,
                const std::optional<double> & range,
                const Events & events);

} // namespace rhombic

#endif
