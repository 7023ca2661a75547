// What is thought of a class before an instance of it was seen to move.
#pragma once

#include <string>
#include <vector>

#include "ofm/base/ids.h"
#include "ofm/dynamics/dynamics_options.h"

namespace ofm {

enum class ClassPolicy {
  kUnknown,        ///< judged by what moves alone
  kMayMove,        ///< presumed to move until it is seen to stand still
  kAlwaysDynamic,  ///< moving whatever it does
  kNeverDynamic,   ///< standing still whatever seems to move
};

/// The policy of each class of a segmenter. A value.
class ClassPolicies {
 public:
  /// Throws Error for a class in two of the options' lists, or one that is not among `class_names`,
  /// unless there are none at all.
  ClassPolicies(const DynamicsOptions& options, const std::vector<std::string>& class_names);

  ClassPolicy Of(ClassId id) const {
    return id.value < policies_.size() ? policies_[id.value] : ClassPolicy::kUnknown;
  }
  /// True for classes that can move by themselves.
  bool MayMove(ClassId id) const {
    return Of(id) == ClassPolicy::kMayMove || Of(id) == ClassPolicy::kAlwaysDynamic;
  }

 private:
  std::vector<ClassPolicy> policies_;  // by ClassId
};

}  // namespace ofm
