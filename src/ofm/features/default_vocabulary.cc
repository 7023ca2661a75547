#include "ofm/features/default_vocabulary.h"

#include <string_view>

#include "ofm/features/vocabulary_file.h"

// The file's bytes as read-only data, so that they cost nothing until they are used and need no
// place on the disk.
asm(R"(
  .pushsection .rodata
  .global ofm_default_vocabulary_begin
  .global ofm_default_vocabulary_end
ofm_default_vocabulary_begin:
  .incbin ")" OFM_DEFAULT_VOCABULARY R"("
ofm_default_vocabulary_end:
  .popsection
)");

extern "C" const char ofm_default_vocabulary_begin[];
extern "C" const char ofm_default_vocabulary_end[];

namespace ofm {

const Vocabulary& DefaultVocabulary() {
  static const Vocabulary vocabulary = DecodeVocabulary(
      {ofm_default_vocabulary_begin, ofm_default_vocabulary_end}, "the default vocabulary");
  return vocabulary;
}

std::shared_ptr<const Vocabulary> SharedDefaultVocabulary() {
  const std::shared_ptr<const void> nobody;  // it outlives all who share it
  return {nobody, &DefaultVocabulary()};
}

}  // namespace ofm
