// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Pieces of text as HTML and JSON in HTML want them, and charts as SVG.
#include "engine/cli/page/html_text.h"

#include <algorithm>

#include "engine/cli/requests.h"

namespace mw::cli {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string script_json(const io::Json& value) {
  std::string out;
  // '<' occurs in strings alone.
  for (const char c : value.dump_ascii()) {
    c == '<' ? out += "\\u003c" : out += c;
  }
  return out;
}

void Base64::add(std::span<const std::byte> bytes) {
  constexpr std::size_t kPiece = 4096;
  for (const std::byte byte : bytes) {
    bits_ = bits_ << 8U | std::to_integer<std::uint32_t>(byte);
    if (++held_ == 3) encode(4);
    if (text_.size() < kPiece) continue;
    append_(text_);
    text_.clear();
  }
}

void Base64::finish() {
  const std::size_t missing = (3 - held_) % 3;
  if (held_ > 0) {
    bits_ <<= 8 * missing;
    encode(4 - missing);
    text_.append(missing, '=');
  }
  append_(text_);
}

/// Appends the first `count` of the four characters that stand for three bytes.
void Base64::encode(std::size_t count) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < count; ++i) text_ += kDigits[bits_ >> (18 - 6 * i) & 63U];
  bits_ = 0;
  held_ = 0;
}

namespace {

// The sides of a chart's view box, and where its columns begin and end at most.
constexpr double kWidth = 270, kHeight = 140, kBase = 116, kTop = 8;

std::string at(double position) {
  return format_fixed(position, 1);
}

std::string column(const Histogram& histogram, std::size_t i, double max) {
  const double width = kWidth / static_cast<double>(histogram.shares.size());
  const double share = histogram.shares[i];
  const double height = share > 0 ? std::max((kBase - kTop) * share / max, 0.8) : 0;
  const double x = static_cast<double>(i) * width;
  const double step =
      (histogram.to - histogram.from) / static_cast<double>(histogram.shares.size());
  const double low = histogram.from + step * static_cast<double>(i);
  return "<rect x=\"" + at(x + 0.5) + "\" y=\"" + at(kBase - height) + "\" width=\"" +
         at(width - 1) + "\" height=\"" + at(height) + "\"><title>" + short_number(low) + " to " +
         short_number(low + step) + histogram.unit + ": " + format_fixed(100 * share, 2) +
         " %</title></rect>";
}

std::string axis(const Histogram& histogram) {
  constexpr int kTicks = 4;
  std::string out = "<path class=\"axis\" d=\"M0 " + at(kBase + 0.5) + "H" + at(kWidth) + "\"/>";
  for (int i = 0; i <= kTicks; ++i) {
    const double share = static_cast<double>(i) / kTicks;
    const char* const anchor = i == 0 ? "start" : i == kTicks ? "end" : "middle";
    const double value = histogram.from + share * (histogram.to - histogram.from);
    // The text is rounded, to drop digits that only binary fractions have.
    const std::string text = format_number(parse_number(format_fixed(value, 4)));
    out += "<text x=\"" + at(share * kWidth) + "\" y=\"" + at(kHeight - 6) + "\" text-anchor=\"" +
           anchor + "\">" + text + histogram.unit + "</text>";
  }
  return out;
}

}  // namespace

std::string histogram_figure(const Histogram& histogram) {
  const auto max = std::max_element(histogram.shares.begin(), histogram.shares.end());
  std::string out = "<figure class=\"card\"><figcaption><b>" + escaped(histogram.title) +
                    "</b><span>" + escaped(histogram.note) + "</span></figcaption>";
  out += "<svg class=\"chart\" viewBox=\"0 0 " + at(kWidth) + " " + at(kHeight) +
         "\" role=\"img\" aria-label=\"" + escaped(histogram.title) + "\">";
  for (std::size_t i = 0; i < histogram.shares.size(); ++i) out += column(histogram, i, *max);
  return out + axis(histogram) + "</svg></figure>\n";
}

std::string bar_figure(const std::string& title, const std::vector<BarRow>& rows) {
  double max = 0;
  for (const BarRow& row : rows) max = std::max(max, row.value);
  std::string out = "<figure class=\"card\"><figcaption><b>" + escaped(title) +
                    "</b></figcaption><table class=\"bars\">";
  for (const BarRow& row : rows) {
    const double share = max > 0 ? 100 * row.value / max : 0;
    out += "<tr><th scope=\"row\">" + escaped(row.name) + "</th><td><i style=\"width:" + at(share) +
           "%\"></i></td><td>" + escaped(row.text) + "</td></tr>";
  }
  return out + "</table></figure>\n";
}

}  // namespace mw::cli
