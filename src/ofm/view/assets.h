// The live view's page, which is part of the program.
#pragma once

#include <map>
#include <string>

#include "ofm/view/web_server.h"

namespace ofm {

/// By path: the page at "/", its looks and its script (with three.js and the licences of both).
std::map<std::string, WebPage> LiveViewPages();

}  // namespace ofm
