#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include <cardiac/protocol/describe.hpp>
#include <cardiac/protocol/plan.hpp>

#include "support/mutation.hpp"
#include "texts.hpp"

namespace {

// Of this process; other work on the machine does not count.
double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

std::vector<std::string> samples() {
  std::vector<std::string> out{kPassive, kBeat};
  for (const char* name : {"healthy_lv", "infarct_lv", "passive_inflation"}) {
    std::ifstream file(std::string(PROJECT_DIR "/protocols/") + name + ".toml");
    out.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return out;
}

std::vector<std::string> words() {
  std::vector<std::string> out{"[",          "]",
                               "[[",         "]]",
                               "{",          "}",
                               "=",          ",",
                               "\n",         "\"",
                               "'''",        "\"\"\"",
                               "#",          ".",
                               "\\",         "\\u",
                               "\0",         "\t",
                               "\xC3\x28",   "\xEF",
                               "\r\n",       "[[region]]\n",
                               "[region]\n", "segments = [1]\n",
                               "true",       "1979-05-27T07:32:00Z",
                               "inf",        "[[[[[[[[[[[[",
                               "{a=",        "\"<script>\"",
                               "../../x.vtu"};
  for (const std::string& path : cardiac::key_paths()) {
    out.push_back(path + " = ");
    out.push_back(path.substr(path.find('.') + 1) + " = ");
    out.push_back('[' + path.substr(0, path.find('.')) + "]\n");
  }
  return out;
}

class ProtocolFuzz : public testing::TestWithParam<unsigned> {};

// Two hundred thousand in all: each is accepted, and then described, or refused with a message.
TEST_P(ProtocolFuzz, IsAcceptedOrRefused) {
  constexpr int kInputs = 50000;
  Mutator texts(samples(), words(), GetParam());
  Mutator options({"tissue.C_kPa=3", "region.1.segments=[1, 2]", "mesh.file=../a.vtu", "region=[]"}, words(),
                  GetParam());
  int accepted = 0;
  double longest_s = 0;
  for (int k = 0; k < kInputs; ++k) {
    const std::string text = texts.next();
    const std::string option = options.next();
    const double begin = processor_s();
    try {
      const auto protocol = k % 4 == 0 ? parsed(text, {option}) : parsed(text);
      cardiac::plan(protocol);
      EXPECT_FALSE(cardiac::resolved_json(protocol).dump().empty());
      ++accepted;
    } catch (const polyaffine::InputError& error) {
      const std::size_t length = std::string(error.what()).size();
      EXPECT_TRUE(length > 0 && length < text.size() + option.size() + 1000) << length;
    } catch (const std::exception& error) {
      FAIL() << "input " << k << ": " << error.what() << "\n" << text;
    }
    longest_s = std::max(longest_s, processor_s() - begin);
  }
  EXPECT_GT(accepted, kInputs / 100) << "the inputs are so wrong that little is tried";
  EXPECT_LT(accepted, kInputs / 2) << "the inputs are hardly wrong";
  EXPECT_LT(longest_s, 5);
  RecordProperty("accepted", accepted);
  RecordProperty("longest_ms", static_cast<int>(1000 * longest_s));
}

INSTANTIATE_TEST_SUITE_P(Seeds, ProtocolFuzz, testing::Values(1, 2, 3, 4));

TEST(Parse, LongInputsAreRefusedAtOnce) {
  const double begin = processor_s();
  const std::string long_word(500000, 'a');
  const auto repeated = [](const std::string& text, int times) {
    std::string out;
    for (int k = 0; k < times; ++k) out += text;
    return out;
  };
  refusal(kPassive + long_word + " = 1\n");
  refusal(kPassive + "[reduction]\nenrichment = [\"" + long_word + "\"]\n");
  refusal(kPassive + "[anatomy]\nlong_axis = " + repeated("[", 100000) + "\n");
  refusal(kPassive + "[anatomy]\nlong_axis = [" + repeated("1, ", 100000) + "]\n");
  refusal(kPassive, {long_word + "=1"});
  refusal(kPassive, {"tissue.law=" + long_word});
  EXPECT_THAT(refusal(kPassive + repeated("[[region]]\nsegments = [1]\n", 20000)),
              testing::HasSubstr("found more than 100 entries [[region]]"));
  EXPECT_LT(processor_s() - begin, 5);
}

}  // namespace
