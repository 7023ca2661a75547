#include "ofm/report/assets.h"

// The files' bytes as read-only data, so that they cost nothing until they are used and need no
// place on the disk.
asm(R"(
  .pushsection .rodata
  .global ofm_report_viewer_begin
  .global ofm_report_viewer_end
  .global ofm_report_style_begin
  .global ofm_report_style_end
  .global ofm_report_plot_style_begin
  .global ofm_report_plot_style_end
ofm_report_viewer_begin:
  .incbin ")" OFM_REPORT_ASSETS R"(/viewer.js"
ofm_report_viewer_end:
ofm_report_style_begin:
  .incbin ")" OFM_REPORT_ASSETS R"(/report.css"
ofm_report_style_end:
ofm_report_plot_style_begin:
  .incbin ")" OFM_REPORT_ASSETS R"(/plot.css"
ofm_report_plot_style_end:
  .popsection
)");

extern "C" const char ofm_report_viewer_begin[];
extern "C" const char ofm_report_viewer_end[];
extern "C" const char ofm_report_style_begin[];
extern "C" const char ofm_report_style_end[];
extern "C" const char ofm_report_plot_style_begin[];
extern "C" const char ofm_report_plot_style_end[];

namespace ofm {

std::string_view ViewerScript() { return {ofm_report_viewer_begin, ofm_report_viewer_end}; }
std::string_view ReportStyle() { return {ofm_report_style_begin, ofm_report_style_end}; }
std::string_view PlotStyle() { return {ofm_report_plot_style_begin, ofm_report_plot_style_end}; }

}  // namespace ofm
