// How well culling tells moving from static, against true masks.
#pragma once

#include <cstddef>
#include <filesystem>

#include "ofm/features/orb_extractor.h"
#include "ofm/perception/mask_folder_segmenter.h"
#include "ofm/pipeline/run_observer.h"

namespace ofm {

/// Counts over a run. "All features" are those that the extractor finds with nothing masked.
struct CullingCounts {
  std::size_t actor_features = 0;          ///< of all features, on true actors
  std::size_t actor_features_kept = 0;     ///< of these, outside the dynamic mask
  std::size_t actor_features_in_pose = 0;  ///< features on true actors that are inliers of a pose
  std::size_t static_features = 0;         ///< of all features, off true actors
  std::size_t static_features_kept = 0;    ///< of these, outside the dynamic mask

  /// Shares, 0 to 1; of nothing: 0 moving ones in the pose, 1 kept.
  double ActorShareInPose() const {
    return actor_features == 0 ? 0 : static_cast<double>(actor_features_in_pose) / actor_features;
  }
  double ActorShareKept() const {
    return actor_features == 0 ? 0 : static_cast<double>(actor_features_kept) / actor_features;
  }
  double StaticShareKept() const {
    return static_features == 0 ? 1 : static_cast<double>(static_features_kept) / static_features;
  }
};

/// Compares each frame's dynamic mask and pose with the instance PNGs of a folder. Extracts
/// features once more per frame: not for use where time counts.
class CullingMeter : public RunObserver {
 public:
  /// Throws Error where the folder does not exist.
  CullingMeter(const std::filesystem::path& true_masks, const OrbOptions& features);

  /// Throws Error where the frame's mask is missing or damaged.
  void OnFrame(const FrameReport& report) override;

  const CullingCounts& counts() const { return counts_; }

 private:
  MaskFolderSegmenter truth_;
  OrbExtractor extractor_;
  CullingCounts counts_;
};

}  // namespace ofm
