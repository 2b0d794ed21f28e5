#include <gtest/gtest.h>

#include <cmath>

#include <cardiac/core/units.hpp>
#include <cardiac/protocol/key.hpp>
#include <cardiac/protocol/protocol.hpp>

namespace cardiac {
namespace {

using protocol::Json;
using protocol::Kind;

// By hand: 1 mmHg = 0.133322387415 kPa, 1 mL = 1000 mm³, 1 s = 1000 ms.
TEST(Units, AreConvertedOnTheWayIntoTheScene) {
  const Protocol p = parse_protocol(R"(
[mesh]
shape = "human_lv"
[contraction]
activation_rate_per_s = 7.0
relaxation_rate_per_s = 40.0
[activation]
[fibres]
[circulation]
filling_pressure_mmHg = 12.0
mitral_resistance_mmHg_s_per_mL = 0.02
compliance_mL_per_mmHg = 1.5
aortic_leak_resistance_mmHg_s_per_mL = 0.3
[time]
heart_rate_bpm = 90
absolute_tolerance_mmHg = 0.2
)",
                                    "units");
  EXPECT_NEAR(p.circulation->filling_pressure_kPa, 1.59986864898, 1e-11);
  EXPECT_NEAR(p.circulation->mitral_resistance_kPa_ms_per_mm3, 0.0026664477483, 1e-13);
  EXPECT_NEAR(p.circulation->compliance_mm3_per_kPa, 11250.9236377, 1e-6);
  EXPECT_NEAR(p.circulation->aortic_leak_resistance_kPa_ms_per_mm3.value(), 0.0399967162245, 1e-12);
  EXPECT_NEAR(p.contraction->activation_rate_per_ms, 0.007, 1e-15);
  EXPECT_NEAR(p.contraction->relaxation_rate_per_ms, 0.04, 1e-15);
  EXPECT_NEAR(p.time.beat_ms, 666.666666666667, 1e-11);
  EXPECT_NEAR(p.time.absolute_tolerance_kPa, 0.026664477483, 1e-13);
}

// What a text says comes out as it went in, whatever the unit of the scene.
TEST(Units, EveryNumberIsToldAsItWasGiven) {
  int converted = 0;
  for (const protocol::Table& table : protocol::tables())
    for (const protocol::Key& key : table.keys) {
      if (key.kind != Kind::number) continue;
      for (const double value : {0.1, 1.0 / 3, 1.3, 7e-3, 123.456, 1e4}) {
        Protocol p = protocol::default_protocol();
        key.set(p, 0, Json(value));
        const double told = key.get(p, 0).get<double>();
        EXPECT_NEAR(told, value, 1e-15 * value) << table.name << '.' << key.name;
        converted += told == value;
      }
      // A default of the scene is a round number in the unit of its key.
      const Json standard = key.get(protocol::default_protocol(), 0);
      if (standard.is_null()) continue;
      const double x = standard.get<double>(), digits = x * 1e6;
      EXPECT_NEAR(digits, std::round(digits), 1e-6 * std::abs(digits)) << table.name << '.' << key.name;
      EXPECT_LE(std::abs(x), 1e5) << table.name << '.' << key.name;
    }
  EXPECT_GT(converted, 300);
}

}  // namespace
}  // namespace cardiac
