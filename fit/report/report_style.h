// The style sheet of reports, for the screen and for paper, and how their pages begin.
#pragma once

#include <string>

namespace vegard::fit {

/// The page's style sheet (CSS). Needs no other file: fonts are the reader's own.
extern const char* const kReportStyle;

/// The beginning of a page with this title, up to and with its header.
std::string headed_page(const std::string& title);

}  // namespace vegard::fit
