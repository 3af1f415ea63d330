"""What a campaign keeps on disk: records, manifest, lock."""
