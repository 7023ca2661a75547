#include "mask_writer.h"

#include "ofm/io/make_folder.h"
#include "ofm/perception/instance_file.h"

namespace ofm {

MaskWriter::MaskWriter(std::filesystem::path folder, std::vector<std::string> class_names)
    : folder_(std::move(folder)), class_names_(std::move(class_names)) {
  MakeFolder(folder_);
}

void MaskWriter::OnFrame(const FrameReport& report) {
  SaveInstances(folder_ / (report.prepared.frame.name + ".json"), report.prepared.segmentation,
                class_names_);
}

}  // namespace ofm
