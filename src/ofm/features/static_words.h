// The words by which a place is known: those of what stands still.
#pragma once

#include "ofm/features/frame_features.h"
#include "ofm/features/vocabulary.h"

namespace ofm {

/// Words of the features that are static with at least `min_probability`: what moves shows no
/// place.
BagOfWords StaticWords(const FrameFeatures& features, const Vocabulary& vocabulary,
                       double min_probability = 0.5);

}  // namespace ofm
