# ONNX Runtime runs Mask R-CNN's ONNX exports, which OpenCV cannot. Debian has it from 13 on.
set(OFM_WITH_ONNXRUNTIME AUTO CACHE STRING
  "Run ONNX exports of Mask R-CNN with ONNX Runtime: AUTO (where it is found), ON or OFF")
set_property(CACHE OFM_WITH_ONNXRUNTIME PROPERTY STRINGS AUTO ON OFF)

set(OFM_ONNXRUNTIME_FOUND OFF)
set(OFM_FIND_ONNXRUNTIME "")  # what an installed package asks for
if(OFM_WITH_ONNXRUNTIME STREQUAL "AUTO")
  find_package(onnxruntime 1.14 CONFIG QUIET)
elseif(OFM_WITH_ONNXRUNTIME)
  find_package(onnxruntime 1.14 CONFIG REQUIRED)
endif()
if(OFM_WITH_ONNXRUNTIME AND onnxruntime_FOUND)
  set(OFM_ONNXRUNTIME_FOUND ON)
  set(OFM_FIND_ONNXRUNTIME "find_dependency(onnxruntime CONFIG)")
  message(STATUS "ONNX Runtime ${onnxruntime_VERSION}: ONNX exports of Mask R-CNN can be run")
elseif(OFM_WITH_ONNXRUNTIME)
  message(STATUS "ONNX Runtime: not found, so ONNX exports of Mask R-CNN cannot be run (install "
    "libonnxruntime-dev, in Debian from 13 on); all else, YOLO networks included, is not affected")
else()
  message(STATUS "ONNX Runtime: off (OFM_WITH_ONNXRUNTIME), so ONNX exports of Mask R-CNN cannot be run")
endif()
