// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// JSON values, held against the library.
#include "io/json/json.h"

#include <nlohmann/json.hpp>

#include "kernels/core/error.h"
#include "tests/testing.h"

namespace mw::io {
namespace {

using nlohmann::ordered_json;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One of each kind; the same braces make a value of ours and one of the library.
template <typename Value>
Value sample() {
  Value out{{"null", nullptr},
            {"yes", true},
            {"int", -3},
            {"large", std::uint64_t{18446744073709551615U}},
            {"doubles", {0.1, 1.0, -0.0, 1e21, 5e-324, 123456789.125, kNaN}},
            {"text", "a \"quote\", \\, \n, \x01, \x7f, é and \xff"},
            {"array", std::array<double, 3>{1, 2.5, 3}},
            {"texts", std::vector<std::string>{"b", "a"}},
            {"nothing", Value::array()},
            {"no fields", Value::object()},
            {"object", {{"z", 1}, {"a", {1, 2}}, {"pair", {"z", 1}}}}};
  out["rows"].push_back({{"label", 7}});
  out["rows"].push_back({"label", 7, true});
  out.update({{"int", 4}, {"more", "é"}});
  out["gone"] = 1;
  out.erase("gone");
  return out;
}

TEST(Json, TextsAreTheLibrarys) {
  const Json ours = sample<Json>();
  const auto theirs = sample<ordered_json>();
  const auto replace = ordered_json::error_handler_t::replace;
  EXPECT_EQ(ours.dump(), theirs.dump(-1, ' ', false, replace));
  EXPECT_EQ(ours.dump_indented(), theirs.dump(2, ' ', false, replace));
  EXPECT_EQ(ours.dump_ascii(), theirs.dump(-1, ' ', true, replace));
  EXPECT_EQ(Json().dump_indented(), "null");
}

TEST(Json, ParsedValuesKeepKindsAndSortKeys) {
  const Json json = parse_json(R"({"b": [18446744073709551615, -1, 1.0, "x", null, false], "a": 1,
                                   "b2": {}, "a": 2})",
                               "f");
  EXPECT_EQ(json.dump(), R"({"a":2,"b":[18446744073709551615,-1,1.0,"x",null,false],"b2":{}})");
  const Json::Array& all = json["b"].elements();
  EXPECT_TRUE(all[0].is_unsigned());
  EXPECT_TRUE(all[1].is_integer() && !all[1].is_unsigned());
  EXPECT_EQ(all[1].integer(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(all[1].number(), -1);
  EXPECT_TRUE(all[2].is_float() && !all[2].is_integer() && all[2].is_number());
  EXPECT_TRUE(all[3] == "x" && all[4] != "x");
  EXPECT_TRUE(all[4].is_null() && all[4].empty() && !all[5].empty());
  EXPECT_FALSE(all[5].boolean());
}

TEST(Json, FieldsAreFoundOrNot) {
  const Json json{{"a", 1}};
  EXPECT_TRUE(json.contains("a"));
  EXPECT_EQ(json.find("b"), nullptr);
  EXPECT_THROW((void)json["b"], std::out_of_range);
  EXPECT_THROW((void)json["a"].text(), std::bad_variant_access);
}

TEST(Json, BrokenTextsAreErrorsThatNameTheFile) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      return parse_json(text, "the file").dump();
    } catch (const Error& error) {
      return error.what();
    }
  };
  EXPECT_NE(message("{\"a\": }").find("the file: JSON: "), std::string::npos);
  EXPECT_NE(message("NaN").find("the file: JSON: "), std::string::npos);
  const auto nested = [](int depth) {
    const auto count = static_cast<std::size_t>(depth);
    return std::string(count, '[') + std::string(count, ']');
  };
  EXPECT_EQ(message(nested(kMaxJsonDepth)), nested(kMaxJsonDepth));
  EXPECT_NE(message(nested(kMaxJsonDepth + 2)).find("nested deeper than 64"), std::string::npos);
}

}  // namespace
}  // namespace mw::io
