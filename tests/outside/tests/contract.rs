//! The promises of every material, tested on a declaration and on a sum.

piola::contract!(stiffening: outside::stiffening()?);
piola::contract!(sum: outside::sum()?);
