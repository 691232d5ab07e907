#include "fit/report/report_style.h"

#include "sim/base/shown_text.h"
#include "sim/base/version.h"

namespace vegard::fit {

const char* const kReportStyle = R"css(
:root { color-scheme: light; --ink: #1d2430; --soft: #5c6675; --line: #e3e7ec; --ground: #f3f5f8; --paper: #ffffff; --mark: #0b5c73; }
@media screen and (prefers-color-scheme: dark) { :root { color-scheme: dark; --ink: #e3e8ee; --soft: #a0acba; --line: #313c4a;
  --ground: #0e141c; --paper: #17202b; --mark: #4fb3cc; } a { color: #8ab8ff; } svg { border-radius: 4px; } }
* { box-sizing: border-box; }
html { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
body { margin: 0; background: var(--ground); color: var(--ink); line-height: 1.5; font-size: 15px;
  font-family: "Helvetica Neue", Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif; }
main, .head { max-width: 1180px; margin: 0 auto; padding: 0 28px; }
header { background: #101826; color: #eef3f7; }
.head { padding-top: 30px; padding-bottom: 26px; }
.head p { margin: 0; color: #a9b8c6; }
h1 { margin: 2px 0 0; font-size: 30px; font-weight: 600; letter-spacing: -0.01em; overflow-wrap: anywhere; }
.verdict { color: #fff; }
.verdict > div { max-width: 1180px; margin: 0 auto; padding: 18px 28px; display: flex; gap: 20px; align-items: baseline; }
.verdict .word { font-size: 24px; font-weight: 700; white-space: nowrap; }
.verdict .answer { font-size: 19px; } .verdict .unit { color: inherit; } .verdict .line { font-size: 15px; margin-top: 6px; }
.verdict summary { cursor: pointer; font-size: 14px; margin-top: 10px; }
.verdict ul { margin: 6px 0 0; padding-left: 20px; font-size: 15px; }
.verdict .checks { list-style: none; padding: 0; margin-top: 12px; font-size: 13px; columns: 2 340px; column-gap: 28px; opacity: 0.92; }
.verdict .checks li { break-inside: avoid; } .verdict .missed { font-weight: 700; }
.verdict.good { background: #17784a; } .verdict.doubtful { background: #a35f00; } .verdict.failed { background: #a82a22; }
.verdict.interrupted { background: #596372; }
section { background: var(--paper); border: 1px solid var(--line); border-radius: 10px; padding: 22px 24px 24px;
  margin: 22px 0; }
h2 { margin: 0 0 12px; font-size: 20px; font-weight: 600; }
h3 { margin: 22px 0 6px; font-size: 15px; font-weight: 600; }
section > p { margin: 0 0 14px; color: var(--soft); max-width: 86ch; }
section > h2 + p { margin-top: -6px; } section > svg + p, section > .plots + p { margin-top: 8px; }
figure { margin: 0; } .large { margin: 22px 0; } .large img { display: block; width: 100%; height: auto; border-radius: 6px; }
.inks span { margin-right: 18px; white-space: nowrap; } .inks i { display: inline-block; width: 22px; height: 10px; margin-right: 6px;
  border: 1px solid var(--soft); border-radius: 2px; } figcaption { color: var(--soft); font-size: 13px; margin-top: 6px; }
figcaption b { color: var(--ink); font-size: 15px; display: block; }
.three { display: grid; grid-template-columns: repeat(3, 1fr); gap: 18px; }
.three img { width: 100%; height: auto; display: block; border-radius: 4px; }
.plots { display: flex; flex-wrap: wrap; gap: 8px 20px; align-items: flex-start; }
svg { max-width: 100%; height: auto; background: #fff; }
.plots > svg { flex: 0 1 auto; }
.misfit img { width: 720px; max-width: 100%; height: auto; display: block; border: 1px solid var(--line); }
.misfit .names { display: grid; grid-template-columns: repeat(3, 1fr); width: 720px; max-width: 100%; font-size: 13px;
  color: var(--soft); text-align: center; }
.scale { display: inline-block; width: 160px; height: 10px; vertical-align: middle; margin: 0 6px;
  background: linear-gradient(to right, #2166ac, #ffffff, #b2182b); border: 1px solid var(--line); }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(230px, 100%), 1fr)); gap: 14px; }
.card { border: 1px solid var(--line); border-left: 4px solid var(--mark); border-radius: 6px; padding: 12px 16px;
  font-size: 14px; color: var(--soft); }
.card.good { border-left-color: #17784a; } .card.doubtful { border-left-color: #a35f00; } .card.unconstrained { border-left-color: var(--line); }
.card .trust { margin-top: 4px; font-size: 13px; }
.card { min-width: 0; overflow-wrap: anywhere; } .card .big { font-size: 19px; font-weight: 600; color: var(--ink); }
.unit { font-weight: 400; font-size: 0.86em; color: var(--soft); }
table { border-collapse: collapse; font-size: 14px; }
.wide, .statistics, .provenance { width: 100%; }
th { text-align: left; font-weight: 600; }
thead th { color: var(--soft); font-size: 13px; border-bottom: 2px solid var(--line); padding: 6px 22px 6px 0; }
.wide tr > :last-child { padding-right: 0; }
tbody td, tbody th { border-bottom: 1px solid var(--line); padding: 7px 22px 7px 0; vertical-align: top; }
tbody tr:last-child > * { border-bottom: 0; }
.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
td.number .soft { white-space: normal; font-weight: 400; }
.compact { font-size: 13px; display: block; overflow-x: auto; } .compact thead th { white-space: normal; vertical-align: bottom; }
.compact th, .compact td { padding-right: 14px !important; } .compact td:nth-child(2) { min-width: 190px; }
.strong { font-weight: 600; font-size: 15px; }
.soft { color: var(--soft); font-size: 13px; }
.flag { display: inline-block; background: #a35f00; color: #fff; font-size: 12px; border-radius: 3px; padding: 0 6px; }
code { font-family: "SFMono-Regular", Consolas, "Liberation Mono", "DejaVu Sans Mono", monospace; font-size: 0.9em;
  overflow-wrap: anywhere; }
.statistics th { width: 190px; } .statistics td.number { width: 120px; padding-right: 24px; }
.provenance th { width: 150px; } .hash { color: var(--soft); font-size: 12px; overflow-wrap: anywhere;
  font-family: "SFMono-Regular", Consolas, "Liberation Mono", "DejaVu Sans Mono", monospace; }
.two { display: flex; flex-wrap: wrap; gap: 10px 40px; align-items: flex-start; }
.two > * { max-width: 100%; overflow-x: auto; } .two .soft { max-width: 480px; }
.matrix td, .matrix th { border: 0; padding: 5px 7px; text-align: center; font-variant-numeric: tabular-nums;
  font-size: 12.5px; min-width: 44px; }
.matrix tbody th { text-align: left; white-space: nowrap; font-weight: 400; padding-left: 0; }
.matrix thead th { border: 0; text-align: center; }
.many { columns: 3; column-gap: 36px; font-size: 13.5px; }
.many > div { display: flex; justify-content: space-between; gap: 12px; border-bottom: 1px solid var(--line);
  padding: 3px 0; break-inside: avoid; font-variant-numeric: tabular-nums; }
.many span { white-space: nowrap; }
pre { white-space: pre-wrap; font-size: 13px; } p, li, pre, footer { overflow-wrap: anywhere; }
footer { color: var(--soft); font-size: 13px; padding: 0 0 40px; }
@media screen and (max-width: 820px) { .three { grid-template-columns: 1fr; } .many { columns: 1; }
  .verdict > div { flex-direction: column; gap: 4px; } .wide { display: block; overflow-x: auto; }
  main, .head, .verdict > div { padding-left: 16px; padding-right: 16px; } section { overflow-x: auto; padding: 16px; } }
@media print { body { background: #fff; font-size: 9.5pt; } table, .card { font-size: 9pt; } .many { font-size: 8pt; }
  .card .big { font-size: 12pt; } .cards { grid-template-columns: repeat(4, 1fr); } .soft, figcaption { font-size: 8pt; }
  .strong { font-size: 9.5pt; } .verdict .line { font-size: 11pt; } .head { padding-top: 12px; padding-bottom: 12px; } section { border: 0; padding: 8px 0; margin: 8px 0; }
  figure, .card, tr, svg, .cards, .misfit { break-inside: avoid; } h2, h3 { break-after: avoid; }
  main, .head, .verdict > div { padding-left: 12px; padding-right: 12px; } .card .big { white-space: normal; }
  .plots, .two { display: block; } .plots > svg { max-height: 105mm; display: block; } @page { margin: 12mm; } }
)css";

std::string headed_page(const std::string& title) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
         sim::html_text(title) + "</title>\n<style>" + kReportStyle +
         "</style>\n</head>\n<body>\n<header><div class=\"head\"><p>vegard " +
         sim::html_text(sim::version()) + "</p>\n<h1>" + sim::html_text(title) + "</h1></div></header>\n";
}

}  // namespace vegard::fit
