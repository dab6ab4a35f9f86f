//! The promises of every material, tested on a declaration.

piola::contract!(stiffening: outside::stiffening()?);
