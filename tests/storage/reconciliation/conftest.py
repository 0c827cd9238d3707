from tests.storage.reconciliation.installation import installed

__all__ = ["installed"]
