#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

/// Wrong inputs: samples changed at random in bytes, words and whole pieces. The same seed gives the same
/// inputs.
class Mutator {
 public:
  /// `words`: what the format means something by, put in anywhere.
  Mutator(std::vector<std::string> samples, std::vector<std::string> words, unsigned seed)
      : samples_(std::move(samples)), words_(std::move(words)), random_(seed) {}

  std::string next() {
    std::string text = any(samples_);
    for (std::size_t edits = 1 + below(4); edits > 0; --edits) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t end) {
    return end == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
  }
  const std::string& any(const std::vector<std::string>& of) { return of[below(of.size())]; }
  std::string piece(const std::string& of) {
    return of.substr(below(of.size()), 1 + below(below(2) == 0 ? 16 : of.size()));
  }

  void change(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    switch (below(8)) {
      case 0:
        if (!text.empty()) text[below(text.size())] = static_cast<char>(below(256));
        break;
      case 1:
        if (!text.empty()) text[below(text.size())] ^= static_cast<char>(1U << below(8));
        break;
      case 2:
        text.erase(at, 1 + below(below(2) == 0 ? 8 : text.size()));
        break;
      case 3:
        text.insert(at, any(words_));
        break;
      case 4:
        text.insert(at, piece(any(samples_)));
        break;
      case 5: {
        std::string repeated;
        const std::string part = below(2) == 0 ? any(words_) : piece(any(samples_));
        for (std::size_t k = below(200); k > 0 && repeated.size() < 20000; --k) repeated += part;
        text.insert(at, repeated);
        break;
      }
      case 6:
        replace_number(text, at);
        break;
      default:
        text.resize(at);
    }
  }

  // The digits after `from` by another number.
  void replace_number(std::string& text, std::size_t from) {
    static const std::vector<std::string> numbers{"0",
                                                  "-1",
                                                  "1e308",
                                                  "-1e-320",
                                                  "1e999",
                                                  "nan",
                                                  "-inf",
                                                  "2147483648",
                                                  "18446744073709551616",
                                                  "-9223372036854775809",
                                                  "0x7f",
                                                  "1_0",
                                                  "3.",
                                                  "1e-9"};
    const std::size_t begin = text.find_first_of("0123456789", from);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(text.find_first_not_of("0123456789.e+-", begin), text.size());
    text.replace(begin, end - begin, any(numbers));
  }

  std::vector<std::string> samples_, words_;
  std::mt19937 random_;
};
