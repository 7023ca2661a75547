// Where a feature lies to a small part of a pixel: its surroundings are laid over those that an
// earlier view has of the same point.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "ofm/base/options.h"
#include "ofm/features/image_patch.h"

namespace ofm {

struct PatchAlignmentOptions {
  double max_shift_px = 2;       ///< in the octave's pixels
  double min_correlation = 0.8;  ///< of grey levels

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("max_shift_px", self.max_shift_px,
          "a feature is moved no further than this [px of its octave]", Range{0.1, 4});
    visit("min_correlation", self.min_correlation,
          "correlation with the earlier view under which a feature stays where it was found",
          Range{0, 1});
  }
};

/// A place in a patch: its offset from the centre [px of the octave].
struct PatchPlace {
  const ImagePatch& patch;
  Eigen::Vector2f offset;
};

/// Lays what is about `reference` over `current` and returns the offset in current.patch at which
/// reference.offset is seen; the search begins at current.offset. `reference_from_current` takes
/// small offsets of the one to the other (2 x 2, both in pixels of their octaves). Gain and bias of
/// the grey levels are free. Gauss-Newton by inverse composition (Baker and Matthews, IJCV 2004).
/// Empty where the surroundings do not fit, show no corner, or are not whole.
std::optional<Eigen::Vector2f> AlignPatch(const PatchPlace& reference, const PatchPlace& current,
                                          const Eigen::Matrix2f& reference_from_current,
                                          const PatchAlignmentOptions& options);

}  // namespace ofm
