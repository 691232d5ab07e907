// The style sheet of reports, for the screen and for paper.
#pragma once

namespace vegard::fit {

/// The page's style sheet (CSS). Needs no other file: fonts are the reader's own.
extern const char* const kReportStyle;

}  // namespace vegard::fit
