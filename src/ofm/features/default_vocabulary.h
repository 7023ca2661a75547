// The vocabulary that comes with the program.
#pragma once

#include "ofm/features/vocabulary.h"

namespace ofm {

/// Made from images of simulated rooms by tools/train_default_vocabulary.cc; for the features of
/// OrbExtractor. Decoded at the first call, which may come from any thread; it never changes.
const Vocabulary& DefaultVocabulary();

}  // namespace ofm
