#include "ofm/dynamics/class_policy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ofm/base/error.h"
#include "ofm/perception/class_names.h"

namespace ofm {

ClassPolicies::ClassPolicies(const DynamicsOptions& options,
                             const std::vector<std::string>& class_names)
    : policies_(class_names.size(), ClassPolicy::kUnknown) {
  if (class_names.empty()) return;
  const auto set = [&](const char* option, const std::vector<std::string>& names,
                       ClassPolicy policy) {
    for (const std::string& name : names) {
      const ClassId id = FindClass(class_names, name);
      if (!id.valid()) {
        throw Error(fmt::format("dynamics.{}: the segmenter knows no class '{}'; it has {}", option,
                                name, fmt::join(class_names, ", ")));
      }
      if (policies_[id.value] != ClassPolicy::kUnknown) {
        throw Error(
            fmt::format("dynamics.{}: '{}' is named twice; a class has one policy", option, name));
      }
      policies_[id.value] = policy;
    }
  };
  set("always_dynamic", options.always_dynamic, ClassPolicy::kAlwaysDynamic);
  set("dynamic_classes", options.dynamic_classes, ClassPolicy::kMayMove);
  set("never_dynamic", options.never_dynamic, ClassPolicy::kNeverDynamic);
}

}  // namespace ofm
