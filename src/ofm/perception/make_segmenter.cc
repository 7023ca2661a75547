#include "ofm/perception/make_segmenter.h"

#include "ofm/base/check.h"
#include "ofm/base/error.h"
#include "ofm/perception/class_names.h"
#include "ofm/perception/mask_folder_segmenter.h"
#include "ofm/perception/null_segmenter.h"
#include "ofm/perception/yolo_seg_segmenter.h"

namespace ofm {
namespace {

std::vector<std::string> ClassNamesFor(const PerceptionOptions& options) {
  if (options.class_names_file.empty()) return CocoClassNames();
  return LoadClassNames(options.class_names_file);
}

std::unique_ptr<Segmenter> MakeYolo(const PerceptionOptions& options) {
  if ((options.input_width == 0) != (options.input_height == 0)) {
    throw Error("perception.input_width and perception.input_height must be set together");
  }
  const YoloSegModel model{options.model, ClassNamesFor(options),
                           cv::Size(options.input_width, options.input_height)};
  const YoloDecoderOptions decoder{options.score_threshold, options.nms_threshold,
                                   options.max_instances};
  return std::make_unique<YoloSegSegmenter>(model, decoder);
}

}  // namespace

std::unique_ptr<Segmenter> MakeSegmenter(const PerceptionOptions& options,
                                         const std::filesystem::path& sequence_folder) {
  switch (options.segmenter) {
    case SegmenterKind::kNone:
      return std::make_unique<NullSegmenter>();
    case SegmenterKind::kMasks: {
      const std::filesystem::path folder = options.masks_folder.empty()
                                               ? sequence_folder / "mask"
                                               : std::filesystem::path(options.masks_folder);
      return std::make_unique<MaskFolderSegmenter>(
          MaskFolder{folder, ClassNamesFor(options), options.mask_class});
    }
    case SegmenterKind::kYoloSeg:
      return MakeYolo(options);
  }
  OFM_CHECK(false);
  return nullptr;
}

}  // namespace ofm
