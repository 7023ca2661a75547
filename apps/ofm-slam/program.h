// Runs the program as a user does. Tests only.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "ofm/io/read_file.h"
#include "ofm/io/test_folder.h"

namespace ofm {

struct ProgramResult {
  int exit_code = -1;
  std::string out, err;  ///< what it wrote to its standard output and error streams
};

/// Runs "ofm-slam `arguments`" in the shell.
inline ProgramResult RunProgram(const std::string& arguments) {
  const TestFolder folder;
  const std::string out = (folder.path() / "out").string(), err = (folder.path() / "err").string();
  const std::string command =
      "{ '" OFM_PROGRAM "' " + arguments + "; } > '" + out + "' 2> '" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, ReadFile(out), ReadFile(err)};
}

}  // namespace ofm
