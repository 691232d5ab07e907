#include "sim/base/shown_text.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/base/error.h"

namespace vegard::sim::shown_text_test {
namespace {

TEST(ShownText, WhatActsOnATerminalIsShownByItsNumber) {
  EXPECT_EQ(shown_text("\x1b[31mred\x1b[0m\a\x7f\r\n\t"), "\\x1b[31mred\\x1b[0m\\x07\\x7f\\x0d\\x0a\\x09");
  EXPECT_EQ(shown_text(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shown_text("\xc2\x9b"
                       "31m"),
            "\\x9b31m");  // C1, as UTF-8
  EXPECT_EQ(shown_text("exe\u202egnp.\u2066x\u2069\u200f"), "exe\\u202egnp.\\u2066x\\u2069\\u200f");  // bidi
  EXPECT_EQ(shown_text("\u2028\ufeff\U000e0041"), "\\u2028\\ufeff\\U000e0041");
}

TEST(ShownText, BytesThatAreNoUtf8AreShownByTheirNumber) {
  EXPECT_EQ(shown_text("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(shown_text("\x9b[2J"), "\\x9b[2J");                       // C1, as Latin-1
  EXPECT_EQ(shown_text("\xc0\x9b"), "\\xc0\\x9b");                    // written longer than need be
  EXPECT_EQ(shown_text("\xe0\x82\x9b"), "\\xe0\\x82\\x9b");           // the same in three bytes
  EXPECT_EQ(shown_text("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half a pair
  EXPECT_EQ(shown_text("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // behind the last
  EXPECT_EQ(shown_text("caf\xc3"), "caf\\xc3");                       // cut off
}

TEST(ShownText, OrdinaryTextStaysAsItIs) {
  const std::string text = "Tromsø 557.7 nm, χ² = 1 µs – 日本 🌌 'quoted' C:\\x1b";
  EXPECT_EQ(shown_text(text), text);
  EXPECT_EQ(shown_lines("one\n\ttwo\n"), "one\n\ttwo\n");
  EXPECT_EQ(shown_lines("one\r\x1b\n"), "one\\x0d\\x1b\n");
  const std::string shown = shown_text("\x1b\xff\u202e");
  EXPECT_EQ(shown_text(shown), shown);
}

TEST(ShownText, WhatIsLongIsShortenedAndSaysByHowMuch) {
  EXPECT_EQ(shortened_text(std::string(200, 'a')), std::string(200, 'a'));
  EXPECT_EQ(shortened_text(std::string(150, 'a') + std::string(1000, 'b') + std::string(50, 'c')),
            std::string(150, 'a') + "[... 1000 bytes left out ...]" + std::string(50, 'c'));
  for (std::size_t shift = 0; shift < 4; ++shift) {
    std::string text(shift, 'a');
    for (int i = 0; i < 200; ++i) text += "🌌";
    EXPECT_EQ(shortened_text(text).find('\\'), std::string::npos) << shift;  // no character is cut
  }
  EXPECT_LT(shortened_text(std::string(6000000, '\x80')).size(), 250u);
}

TEST(ShownText, WhatIsLongOnlyWhenItIsShownIsShortenedToo) {
  EXPECT_EQ(shortened_text(std::string(50, '\0')), shown_text(std::string(50, '\0')));
  std::string begin, end;
  for (int i = 0; i < 37; ++i) begin += "\\x00";
  for (int i = 0; i < 12; ++i) end += "\\x00";
  EXPECT_EQ(shortened_text(std::string(100, '\0')), begin + "[... 51 bytes left out ...]" + end);
  for (const char byte : {'\0', '\x80', '\xf4', '\x1b'})
    for (std::size_t size : {51u, 52u, 199u, 200u, 201u, 5000u}) {
      const std::string text = shortened_text(std::string(size, byte));
      EXPECT_GT(text.size(), 200u) << size;
      EXPECT_LT(text.size(), 240u) << size;
    }
}

TEST(ShownText, QuotedValuesAreShortenedEachByItself) {
  const std::string mega(1000000, 'k');
  const std::string text =
      shortened_quotes("the scene's key '" + mega + "' is unknown, as is '" + mega + "'");
  EXPECT_EQ(text.find("the scene's key 'kkk"), 0u);
  EXPECT_NE(text.find("kkk' is unknown, as is 'kkk"), std::string::npos);
  EXPECT_EQ(text.back(), '\'');
  EXPECT_NE(text.find("[... 999800 bytes left out ...]"), std::string::npos);
  EXPECT_LT(text.size(), 600u);
  EXPECT_LT(shortened_quotes("no quotes " + mega).size(), 1300u);
  const std::string short_one = "'it's' the camera's 'own' words";
  EXPECT_EQ(shortened_quotes(short_one), short_one);
}

TEST(ShownText, AnErrorIsSafeToShowAndKeepsItsPartsAsTheyAre) {
  const std::string problem = "'" + std::string(5000, '\x1b') + "' is no number", key(5000, 'k');
  const Error error = Error(ErrorKind::scene, problem).file("a\x1b]0;title\a.toml").key(key);
  const std::string text = error.what();
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\a'), std::string::npos);
  EXPECT_LT(text.size(), 2000u);
  EXPECT_NE(text.find("is no number"), std::string::npos);
  EXPECT_EQ(error.details().problem, problem);

  // A file of a list whose name is a megabyte of zeros.
  const Error of_list = Error(ErrorKind::unreadable_input, problem).file(std::string(1000000, '\0')).key(key);
  EXPECT_LT(std::string(of_list.what()).size(), 2000u);
}

TEST(ShownText, PagesHaveNoCharacterThatIsNone) {
  EXPECT_EQ(html_text("\xed\xa0\x80<"), "\ufffd\ufffd\ufffd&lt;");
}

}  // namespace
}  // namespace vegard::sim::shown_text_test
