//! Short maps: lists in the order of their keys.
//!
//! The maps of this crate have a few entries. It is compiled before every crate that declares a material, and
//! a list is compiled and searched in less time than a tree.

pub(crate) type Sorted<K, V> = Vec<(K, V)>;

/// The value of a key, initially the default.
pub(crate) fn entry<K: Ord, V: Default>(map: &mut Sorted<K, V>, key: K) -> &mut V {
    let k = map.binary_search_by(|(other, _)| other.cmp(&key)).unwrap_or_else(|k| {
        map.insert(k, (key, V::default()));
        k
    });
    &mut map[k].1
}
