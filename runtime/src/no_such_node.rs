//! Error of node numbers that do not exist, for every module that takes nodes.

use std::fmt;

/// Error of a node number beyond the number of nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoSuchNode {
    /// The tetrahedron that uses it, if one does: its tag in a mesh with tags, else its index from 0.
    pub element: Option<usize>,
    /// The missing node.
    pub node: usize,
    /// Number of nodes.
    pub nodes: usize,
}

impl fmt::Display for NoSuchNode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { element, node, nodes } = self;
        match element {
            Some(element) => write!(f, "element {element} names node {node}")?,
            None => write!(f, "there is no node {node}")?,
        }
        write!(f, ": the {nodes} nodes are numbered from 0")
    }
}

impl std::error::Error for NoSuchNode {}
