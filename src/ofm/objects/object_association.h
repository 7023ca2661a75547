// Which observations are of one thing: steps 1 to 3 of JoinObjects.
#pragma once

#include <vector>

#include "ofm/objects/object_hypothesis.h"
#include "ofm/objects/object_options.h"

namespace ofm {

/// Adds a key frame's observations to the hypotheses they overlap with most, or makes new ones.
void AssociateKeyframe(std::vector<PlacedObservation> observations,
                       const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses);

/// Merges hypotheses that overlap, those that overlap most first, until none does.
void MergeHypotheses(const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses);

/// Merges those at one place that share few voxels, as where the depth of a dark screen is bad:
/// closer than some spreads of the larger one, if no key frame told them apart; those of different
/// classes closer than some of the smaller one, if they are of like size, as solid things cannot
/// be.
void MergeNear(const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses);

/// Drops those that are weak and lie within another of like size.
void DropParts(const ObjectJoinOptions& options, std::vector<ObjectHypothesis>& hypotheses);

}  // namespace ofm
