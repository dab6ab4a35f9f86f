//! The test suite of every material, applied to this one.

use biderman::Biderman;
use piola::Inversion;

piola::contract!(rubber: Biderman::new(1.837e5, 3.589e3, -1.938e3, 46.02, 2e7)?);

piola::contract!(
    beyond_inversion: Biderman::new(1.837e5, 3.589e3, -1.938e3, 46.02, 2e7)?
        .with_inversion(Inversion::Extend { epsilon: 0.1 })?
);
