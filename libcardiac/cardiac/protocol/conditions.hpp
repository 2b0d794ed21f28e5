#pragma once

#include <cardiac/protocol/key.hpp>

/// When keys play a part, beside the key that they are used with (KeyFacts::used_with). For the tables of
/// keys only.
namespace cardiac::protocol {

/// Something contracts.
Condition contracts();
/// Beats in a circulation are computed, not a prescribed pressure.
Condition beats();
/// Time passes: something contracts, or the cavities follow given curves.
Condition in_time();
/// The pressure of the cavities is one number; it or their volume is a table.
Condition one_pressure();
/// Calcium follows its formula.
Condition calcium_formula();
Condition files();
/// The circulation consists of windkessels; it is a network of one's own.
Condition windkessels();
Condition networks();
/// The pressure is prescribed, or nothing but the contraction loads the wall.
Condition prescribed();
/// The model is a reduced one.
Condition reduced();
/// Its functions and points are not learned.
Condition untrained();
/// The law has a volumetric energy of its own.
Condition separate_volume();
/// That is kept by a pressure space, of which a local bulk modulus takes a part.
Condition mixed();
/// The reduced model has tent weights.
Condition tents();
/// The mesh has one ventricle, or two.
Condition one_ventricle();
Condition two_ventricles();
/// The muscle contracts or its law is anisotropic.
Condition along_fibres();
/// The law tells sheets from their normals; the active tension does not.
Condition along_sheets();
/// Springs or dashpots hold the epicardium.
Condition held();
/// The entry of [[region]] differs from the rest; some entry does.
Condition differs();
Condition some_differ();

}  // namespace cardiac::protocol
