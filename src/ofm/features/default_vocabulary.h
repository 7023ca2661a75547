// The vocabulary that comes with the program.
#pragma once

#include <memory>

#include "ofm/features/vocabulary.h"

namespace ofm {

/// Made from images of simulated rooms by tools/train_default_vocabulary.cc; for the features of
/// OrbExtractor. Decoded at the first call, which may come from any thread; it never changes.
const Vocabulary& DefaultVocabulary();

/// The same, for those who share their vocabulary. Never null.
std::shared_ptr<const Vocabulary> SharedDefaultVocabulary();

}  // namespace ofm
