#include "ofm/dense/dense_options.h"

#include <fmt/format.h>

#include "ofm/base/error.h"

namespace ofm {

void CheckOptions(const DenseOptions& options) {
  DenseOptions copy = options;
  for (const OptionField& field : OptionFields(copy)) {
    try {
      field.parse(field.print());
    } catch (const Error& error) {
      throw Error(fmt::format("dense.{}: {}", field.path, error.what()));
    }
  }
  if (options.navigation.min_height_m >= options.navigation.max_height_m) {
    throw Error("dense.navigation.min_height_m must be under dense.navigation.max_height_m");
  }
}

}  // namespace ofm
