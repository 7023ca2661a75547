#include "ofm/view/assets.h"

// The files' bytes as read-only data.
asm(R"(
  .pushsection .rodata
  .global ofm_live_page_begin
  .global ofm_live_page_end
  .global ofm_live_style_begin
  .global ofm_live_style_end
  .global ofm_live_script_begin
  .global ofm_live_script_end
ofm_live_page_begin:
  .incbin ")" OFM_VIEW_ASSETS R"(/live.html"
ofm_live_page_end:
ofm_live_style_begin:
  .incbin ")" OFM_VIEW_ASSETS R"(/live.css"
ofm_live_style_end:
ofm_live_script_begin:
  .incbin ")" OFM_VIEW_ASSETS R"(/live.js"
ofm_live_script_end:
  .popsection
)");

extern "C" const char ofm_live_page_begin[], ofm_live_page_end[];
extern "C" const char ofm_live_style_begin[], ofm_live_style_end[];
extern "C" const char ofm_live_script_begin[], ofm_live_script_end[];

namespace ofm {

std::map<std::string, WebPage> LiveViewPages() {
  return {{"/", {"text/html; charset=utf-8", {ofm_live_page_begin, ofm_live_page_end}}},
          {"/live.css", {"text/css; charset=utf-8", {ofm_live_style_begin, ofm_live_style_end}}},
          {"/live.js",
           {"text/javascript; charset=utf-8", {ofm_live_script_begin, ofm_live_script_end}}}};
}

}  // namespace ofm
