from tests.storage.reconciliation.installation import installed, whole
