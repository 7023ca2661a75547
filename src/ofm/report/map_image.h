// A labelled cloud from above, as a picture.
#pragma once

#include <functional>
#include <optional>

#include "ofm/dense/labelled_point.h"
#include "ofm/report/plot.h"
#include "ofm/report/report_data.h"

namespace ofm {

/// Paints each cell of the plan in the colour of the class that most of its labelled points have,
/// else in a paler tone of its highest point's own colour; cells without a point are transparent.
/// Points more than 0.3 m above the highest camera are left out: they are the ceiling. Cells are 4
/// cm, or larger where the cloud is too thin or too wide for them. Empty where no point is left.
std::optional<PlotImage> DrawMapFromAbove(const LabelledCloud& cloud, const PlanView& plan,
                                          const RunView& run);

}  // namespace ofm
