#include "ofm/io/make_folder.h"

#include "ofm/base/error.h"

namespace ofm {

void MakeFolder(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw Error(path, "cannot be made (" + error.message() + ")");
}

}  // namespace ofm
