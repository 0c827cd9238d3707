"""Results of one attempt of a job: a Zarr v3 store that is written shard by shard.

`writer` fills a store, `reader` reads it, also while it grows; `layout` says what it holds. The
package stores named columns over time and knows nothing of their meaning.
"""
