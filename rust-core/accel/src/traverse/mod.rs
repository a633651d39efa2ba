//! Traversal by single rays, packets and ray streams, and the queries that choose among them.

pub(crate) mod beam;
mod packet;
mod packet_query;
mod packet_ray;
mod packet_scene;
mod query;
mod single;
mod single_scene;
mod stream;
mod stream_ray;
pub(crate) mod stream_tuner;
