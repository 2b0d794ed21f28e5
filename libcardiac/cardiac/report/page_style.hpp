#pragma once

#include <string_view>

namespace cardiac {

/// The style sheet of report.html: one column on a phone, plain on paper.
inline constexpr std::string_view kPageStyle = R"css(
:root{--ink:#1d2530;--soft:#5b6673;--line:#dde2e8;--panel:#f6f8fa;--accent:#0b5c8a}
html{color-scheme:light}
*{box-sizing:border-box}
body{margin:0;font:16px/1.5 system-ui,-apple-system,"Segoe UI",Helvetica,Arial,sans-serif;color:var(--ink);background:#fff}
main,header,footer{max-width:1120px;margin:0 auto;padding:0 20px}
header{padding-top:28px}
h1{font-size:1.75rem;line-height:1.2;margin:0 0 4px;overflow-wrap:anywhere}
h2{font-size:1.2rem;margin:40px 0 12px;padding-bottom:6px;border-bottom:1px solid var(--line)}
h3{font-size:1rem;margin:20px 0 8px;color:var(--soft)}
p.sub{margin:0;color:var(--soft)}
.alert{margin:16px 0 0;padding:12px 16px;border-left:5px solid #b7791f;background:#fff8e6;border-radius:4px;overflow-wrap:anywhere}
.alert.stop{border-color:#b2182b;background:#fdecec}
.alert strong{display:block}
.alert.stop{border-left-width:10px}
.alert.stop strong{font-size:2.1rem;line-height:1.15;margin-bottom:6px;color:#8f1320}
.alert ul{margin:4px 0 0;padding-left:20px}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(168px,1fr));gap:12px}
.card{background:var(--panel);border:1px solid var(--line);border-radius:8px;padding:10px 14px}
.card .name{font-size:.85rem;color:var(--soft)}
.card .value{font-size:1.6rem;font-weight:650;line-height:1.25;white-space:nowrap}
.card .unit{font-size:.9rem;font-weight:400;color:var(--soft)}
.card .note{font-size:.78rem;color:var(--soft)}
.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,460px),1fr));gap:20px;align-items:start}
.eyes{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,300px),1fr));gap:12px}
figure{margin:0}
figure svg{display:block;width:100%;height:auto;max-width:680px;margin:0 auto}
.eyes figure svg{max-width:420px}
.full{display:grid;gap:28px}
.full figure svg{max-width:1000px}
.wide{overflow-x:auto;-webkit-overflow-scrolling:touch}
table{border-collapse:collapse;font-size:.88rem;font-variant-numeric:tabular-nums}
.wide>table{width:100%}
.wide>table.facts{width:auto}
th,td{padding:5px 10px;text-align:right;border-bottom:1px solid var(--line);vertical-align:top}
thead th{color:var(--soft);font-weight:600;white-space:nowrap}
th.left,td.left{text-align:left}
td.text{text-align:left;min-width:12em}
tbody tr:hover{background:var(--panel)}
thead th[colspan]{text-align:center}
.group{border-left:1px solid var(--line)}
.yes,.no{font-weight:600;white-space:nowrap}
.yes{color:#0b6b4f}.no{color:var(--soft)}
.source{color:var(--soft)}
ul.assumptions{margin:8px 0;padding-left:22px}
ul.assumptions li{margin:4px 0}
p.small,footer{font-size:.85rem;color:var(--soft)}
footer{padding:28px 20px 40px}
details{margin-top:12px}
summary{cursor:pointer;color:var(--accent)}
pre{background:var(--panel);border:1px solid var(--line);border-radius:6px;padding:12px;overflow-x:auto;font-size:.8rem}
@media(max-width:480px){main,header,footer{padding-left:14px;padding-right:14px}.cards{grid-template-columns:repeat(2,1fr);gap:8px}.card .value{font-size:1.35rem}}
@media print{h2{break-after:avoid}figure,.card,tr{break-inside:avoid}details{display:none}.eyes{grid-template-columns:repeat(2,1fr)}.cards{grid-template-columns:repeat(3,1fr)}.pair{grid-template-columns:repeat(2,1fr)}body{font-size:11pt}.wide{overflow:visible}}
)css";

}  // namespace cardiac
