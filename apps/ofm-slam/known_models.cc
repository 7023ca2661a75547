#include "known_models.h"

#include <algorithm>
#include <array>

namespace ofm {
namespace {

constexpr std::string_view kOurExport = "the file that docs/results.md was measured with";
constexpr std::string_view kUltralytics = "AGPL-3.0";
constexpr std::string_view kUseYolo = "ofm-slam run SEQUENCE --segmenter yolo-seg --model FILE";

// Hashes are those that somebody publishes or that were measured on the file named; none is
// guessed.
constexpr std::array kModels = {
    KnownModel{
        "mask-rcnn-inception-v2", "mask_rcnn_inception_v2_coco_2018_01_28.tar.gz", "Apache-2.0",
        "4f57861c2ff1c87e92495789ee266e41a7dc79a038521d93a153be403b0b601f",
        "OpenVINO's open model zoo, models/public/mask_rcnn_inception_v2_coco/model.yml", 177817887,
        "http://download.tensorflow.org/models/object_detection/"
        "mask_rcnn_inception_v2_coco_2018_01_28.tar.gz",
        "",
        "unpack it (tar -xzf FILE) and fetch mask-rcnn-inception-v2-graph too; then ofm-slam run "
        "SEQUENCE --segmenter mask-rcnn --model "
        "mask_rcnn_inception_v2_coco_2018_01_28/frozen_inference_graph.pb --model-graph "
        "mask_rcnn_inception_v2_coco_2018_01_28.pbtxt"},
    KnownModel{"mask-rcnn-inception-v2-graph", "mask_rcnn_inception_v2_coco_2018_01_28.pbtxt",
               "see its repository", "", "", 0,
               "https://raw.githubusercontent.com/opencv/opencv_extra/4.x/testdata/dnn/"
               "mask_rcnn_inception_v2_coco_2018_01_28.pbtxt",
               "", "--model-graph FILE, with mask-rcnn-inception-v2"},
    KnownModel{"mask-rcnn-r50-fpn", "MaskRCNN-12.onnx", "MIT",
               "5bf940c124d9117f6fae350c4e0d46df180cbb01981832b35fdbed148078b946",
               "git-lfs pointer in github.com/onnx/models", 177970010,
               "https://huggingface.co/onnxmodelzoo/legacy_models/resolve/main/validated/vision/"
               "object_detection_segmentation/mask-rcnn/model/MaskRCNN-12.onnx",
               "", "ofm-slam run SEQUENCE --segmenter mask-rcnn --model FILE (needs ONNX Runtime)"},
    KnownModel{"mask-rcnn-r50-fpn-int8", "MaskRCNN-12-int8.onnx", "MIT",
               "96388cfb596cbdb9a38dca16f1c22a1533843a030b094cdea3f1a2c90ef79156",
               "git-lfs pointer in github.com/onnx/models", 48137510,
               "https://huggingface.co/onnxmodelzoo/legacy_models/resolve/main/validated/vision/"
               "object_detection_segmentation/mask-rcnn/model/MaskRCNN-12-int8.onnx",
               "", "ofm-slam run SEQUENCE --segmenter mask-rcnn --model FILE (needs ONNX Runtime)"},
    KnownModel{"mask-rcnn-torchvision", "maskrcnn_resnet50_fpn.onnx", "BSD-3-Clause", "", "", 0,
               "https://download.pytorch.org/models/maskrcnn_resnet50_fpn_coco-bf2d0c1e.pth",
               "python3 -c \"import torch, torchvision as t; torch.onnx.export("
               "t.models.detection.maskrcnn_resnet50_fpn(weights='DEFAULT').eval(), "
               "[torch.rand(3, 480, 640)], 'maskrcnn_resnet50_fpn.onnx', opset_version=11)\"",
               "ofm-slam run SEQUENCE --segmenter mask-rcnn --model FILE (needs ONNX Runtime)"},
    KnownModel{"yolov8n-seg-256x320", "yolov8n-seg_256x320.onnx", kUltralytics,
               "d602b53acd30aac2031a4da4e908be1651f9e6a95aa468eec11c7d9227e8348e", kOurExport,
               13696493,
               "https://github.com/ultralytics/assets/releases/download/v8.3.0/yolov8n-seg.pt",
               "yolo export model=yolov8n-seg.pt format=onnx imgsz=256,320 opset=13 "
               "(pip install ultralytics; another version makes another file)",
               kUseYolo},
    KnownModel{"yolov8n-seg-480x640", "yolov8n-seg_480x640.onnx", kUltralytics,
               "b80dc0b9e01cae77e1ab7c8e07a6b493391b3fef5cd573c66ee25299a218675d", kOurExport,
               13844334,
               "https://github.com/ultralytics/assets/releases/download/v8.3.0/yolov8n-seg.pt",
               "yolo export model=yolov8n-seg.pt format=onnx imgsz=480,640 opset=13 "
               "(pip install ultralytics; another version makes another file)",
               kUseYolo},
    KnownModel{"yolo11n-seg-384x512", "yolo11n-seg_384x512.onnx", kUltralytics,
               "9e02d033afe74db38130f648e1a1fbf700fb1a602570f89ad163a30b4b027d46", kOurExport,
               11637449,
               "https://github.com/ultralytics/assets/releases/download/v8.3.0/yolo11n-seg.pt",
               "yolo export model=yolo11n-seg.pt format=onnx imgsz=384,512 opset=13 "
               "(pip install ultralytics; another version makes another file)",
               kUseYolo},
    KnownModel{"yolov5n-seg", "yolov5n-seg.onnx", kUltralytics, "", "", 0,
               "https://github.com/ultralytics/yolov5/releases/download/v7.0/yolov5n-seg.pt",
               "python3 export.py --weights yolov5n-seg.pt --include onnx --imgsz 480 640 "
               "--opset 13 (in a checkout of github.com/ultralytics/yolov5)",
               kUseYolo},
};

const KnownModel* Find(std::string_view KnownModel::*field, std::string_view value) {
  const auto found = std::find_if(kModels.begin(), kModels.end(),
                                  [&](const KnownModel& model) { return model.*field == value; });
  return found == kModels.end() || value.empty() ? nullptr : &*found;
}

}  // namespace

std::span<const KnownModel> KnownModels() { return kModels; }

const KnownModel* FindModelByName(std::string_view name) { return Find(&KnownModel::name, name); }
const KnownModel* FindModelByFile(std::string_view file) { return Find(&KnownModel::file, file); }
const KnownModel* FindModelBySha256(std::string_view sha256) {
  return Find(&KnownModel::sha256, sha256);
}

}  // namespace ofm
