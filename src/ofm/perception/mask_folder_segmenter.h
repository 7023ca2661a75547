// Instances from image files: ground truth, or the output of another program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ofm/perception/segmenter.h"

namespace ofm {

/// What counts where a frame has both files.
enum class MaskFiles {
  kLists,   ///< NAME.json: what a network would find
  kImages,  ///< NAME.png: what truly moves
};

/// What a folder of masks holds.
struct MaskFolder {
  std::filesystem::path path;
  std::vector<std::string> class_names;  ///< mask_class is added where it is not among them
  std::string mask_class = "person";     ///< class of every instance of an image
  MaskFiles preferred = MaskFiles::kLists;
};

/// For the frame called NAME reads FOLDER/NAME.json (see instance_file.h: with classes, scores and
/// overlaps) or FOLDER/NAME.png, the preferred one where there are both. An image has one channel
/// of 8 or 16 bits and the frame's size; 0 = static, k = instance k. Its instances have the score 1
/// and are ordered by number.
class MaskFolderSegmenter : public Segmenter {
 public:
  /// Throws Error where the folder does not exist.
  explicit MaskFolderSegmenter(MaskFolder folder);

  /// Throws Error that names the file where it is missing, damaged, of another type or size, or has
  /// more than 255 instances (as a depth image taken for masks has).
  Segmentation Segment(const RgbdFrame& frame) override;
  const std::vector<std::string>& class_names() const override { return folder_.class_names; }

 private:
  MaskFolder folder_;
  ClassId class_id_;
};

}  // namespace ofm
