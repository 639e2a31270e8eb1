"""Along Sigma: the sliding flow, where it slides or crosses, the Filippov convention."""
