#include "ofm/features/node_matching.h"

#include <algorithm>
#include <map>

#include "ofm/base/check.h"

namespace ofm {
namespace {

/// Features of one node.
struct Group {
  std::vector<int> features;
  std::vector<Descriptor> descriptors;
};

std::map<std::uint32_t, Group> GroupByNode(const IndexedDescriptors& indexed) {
  OFM_CHECK(indexed.descriptors.size() == indexed.nodes.size());
  std::map<std::uint32_t, Group> groups;
  for (std::size_t i = 0; i < indexed.nodes.size(); ++i) {
    Group& group = groups[indexed.nodes[i]];
    group.features.push_back(static_cast<int>(i));
    group.descriptors.push_back(indexed.descriptors[i]);
  }
  return groups;
}

}  // namespace

std::vector<FeatureMatch> MatchByNode(const IndexedDescriptors& a, const IndexedDescriptors& b,
                                      const MatchOptions& options) {
  const std::map<std::uint32_t, Group> groups_of_a = GroupByNode(a), groups_of_b = GroupByNode(b);
  std::vector<FeatureMatch> matches;
  for (const auto& [node, group_a] : groups_of_a) {
    const auto found = groups_of_b.find(node);
    if (found == groups_of_b.end()) continue;
    const Group& group_b = found->second;
    for (const FeatureMatch& match :
         MatchBruteForce(group_a.descriptors, group_b.descriptors, options)) {
      matches.push_back({group_a.features[match.a], group_b.features[match.b], match.distance});
    }
  }
  std::ranges::sort(matches, {}, &FeatureMatch::a);
  return matches;
}

}  // namespace ofm
